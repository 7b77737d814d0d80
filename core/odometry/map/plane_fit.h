// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/odometry/map/point_map.h"

namespace trajlo {

/// When the neighbours of a point make a plane. With the standard deviations l0 <= l1 <= l2 of the
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

/// The plane normalᵀ x = offset in the world frame.
struct Plane {
  Eigen::Vector3d normal_world;
  double offset_m;
  double thickness_m;  ///< l0
  double width_m;      ///< l1
  /// Relative information of a distance to it, in (0, 1].
  double weight = 1.0;
  /// Spacing of the map it comes from, in those of the finest.
  double scale = 1.0;
};

/// The plane through the neighbours by principal component analysis; false when they make none.
/// `spacing_m` is the least distance between points of the map.
bool FitPlane(const Neighbors& neighbors, const PlaneFitOptions& options, double spacing_m,
              Plane* plane);

}  // namespace trajlo
