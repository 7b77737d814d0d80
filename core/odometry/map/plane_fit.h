// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/odometry/map/neighbors.h"

namespace trajlo {

/// When the neighbours of a place make a plane. With the standard deviations l0 <= l1 <= l2 of the
/// neighbours along their principal axes:
struct PlaneFitOptions {
  /// Points taken for a plane (paper: 5).
  int neighbors = 8;
  int min_neighbors = 5;
  /// Upper bound of l0: how thick a plane may be.
  double max_thickness_m = 0.15;
  /// Lower bound of l1, in spacings of the map's points: neighbours on one scan line have no
  /// normal.
  double min_width_in_spacings = 0.53;
  /// Upper bound of l0 / l1.
  double max_flatness = 0.5;
  /// Planes that meet the ray to the point which asks at a smaller angle than this sine's are taken
  /// only where there is no other. Neighbours on one scan line that is ragged (a facade with
  /// recesses, leaves) span the cone of that beam: a plane through the sensor, which would hold the
  /// sensor where it was.
  double min_incidence_sine = 0.1;
  /// Upper bound of l0 / l1 for a plane of a coarser level that is preferred to those of the finer
  /// ones; it must be thinner than `half_weight_thickness_m`, too. 0 never prefers one.
  double max_wide_flatness = 0.1;
  /// Upper bound of the distance from such a plane to the point that asks for it, in l1: farther
  /// off stands something else, which the coarser levels have no points of (a post before a wall).
  double max_wide_distance_in_widths = 0.3;
  /// A plane of this thickness weighs half as much as a thin one.
  double half_weight_thickness_m = 0.05;
};

/// The plane nᵀ (x - center) = offset about a center in the world frame that is kept elsewhere.
struct FittedPlane {
  Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();
  float offset_m = 0.0F;
  float thickness_m = 0.0F;  ///< l0
  float width_m = 0.0F;      ///< l1; zero says that there is no plane.

  bool exists() const { return width_m > 0.0F; }
};

/// The plane through the neighbours of `center_world` by principal component analysis; one that
/// does not exist where they make none. `spacing_m` is the least distance between points of the
/// map.
FittedPlane FitPlane(const Neighbors& neighbors, const Eigen::Vector3d& center_world,
                     const PlaneFitOptions& options, double spacing_m);

}  // namespace trajlo
