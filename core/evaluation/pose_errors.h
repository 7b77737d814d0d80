// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// Errors of a list of poses or relative poses, each derived from E, the pose of the truth seen
/// from the estimate (or the other way round: the norms are the same).
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_deg;
  /// Frobenius norms of R_E - I and of the 4x4 E - I; they mix radians and metres.
  std::vector<double> rotation_part;
  std::vector<double> full;
  /// Of relative poses only: the difference of the two distances, for truth without orientation.
  std::vector<double> point_distance_m;
};

/// The rotation angle in degrees. Exact at 0 and stable for matrices that are orthonormal to a few
/// digits only, where acos of the trace would be off by the square root of that error.
inline double RotationAngleDeg(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d skew(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(0.5 * skew.norm(), 0.5 * (R.trace() - 1.0)) * (180.0 / M_PI);
}

/// The inverse of a pose whose rotation may be orthonormal to a few digits only: [Rᵀ, -Rᵀ t].
inline Eigen::Affine3d RigidInverse(const Eigen::Affine3d& T) { return T.inverse(Eigen::Isometry); }

inline void AppendRotationErrors(const Eigen::Affine3d& E, PoseErrors* errors) {
  errors->rotation_deg.push_back(RotationAngleDeg(E.linear()));
  const double rotation_part = (E.linear() - Eigen::Matrix3d::Identity()).norm();
  errors->rotation_part.push_back(rotation_part);
  errors->full.push_back(std::hypot(rotation_part, E.translation().norm()));
}

}  // namespace trajlo
