// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/map/point_map.h"

namespace trajlo {

/// When the neighbours of a point make a plane. With the standard deviations l0 <= l1 <= l2 of the
/// neighbours along their principal axes:
struct PlaneFitOptions {
  /// Points taken for a plane (paper: 5).
  int neighbors = 8;
  int min_neighbors = 5;
  /// Upper bound of l0: how thick a plane may be.
  double max_thickness_m = 0.15;
  /// Lower bound of l1: neighbours on one scan line have no normal.
  double min_width_m = 0.08;
  /// Upper bound of l0 / l1.
  double max_flatness = 0.5;
};

/// The plane normalᵀ x = offset in the world frame.
struct Plane {
  Eigen::Vector3d normal_world;
  double offset_m;
  double thickness_m;  ///< l0
  double width_m;      ///< l1
};

/// The plane through the neighbours by principal component analysis; false when they make none.
bool FitPlane(const Neighbors& neighbors, const PlaneFitOptions& options, Plane* plane);

}  // namespace trajlo
