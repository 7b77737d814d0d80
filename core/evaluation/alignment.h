// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/association.h"

namespace trajlo {

/// What brings the estimate's world frame onto the truth's.
///   kNone    nothing
///   kOrigin  the first pose of the estimate onto the first pose of the truth, attitude included
///   kSe3     rotation and translation of least squares over the positions
///   kSim3    the same with a scale
///   kScale   the scale of kSim3 alone
/// S. Umeyama, Least-squares estimation of transformation parameters between two point patterns,
/// 1991.
enum class AlignmentKind { kNone, kOrigin, kSe3, kSim3, kScale };

inline bool HasScale(AlignmentKind kind) {
  return kind == AlignmentKind::kSim3 || kind == AlignmentKind::kScale;
}

struct AlignmentOptions {
  AlignmentKind kind = AlignmentKind::kSe3;
  /// Positive: it is computed from this many pairs at the beginning, and applied to all.
  std::size_t first_pairs = 0;
  /// Positive: it is computed from the pairs of this many seconds at the beginning.
  double first_seconds = 0.0;
};

/// Similarity p_truth_world = scale * R * p_estimate_world + t.
struct Alignment {
  AlignmentKind kind = AlignmentKind::kNone;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
  double scale = 1.0;
  std::size_t pairs_used = 0;
  /// How well the positions fix the rotation. A turn by sigma about its axis, a column in the
  /// truth's world, moves the positions by as much as they differ (rms): one error along the path
  /// counts once, however many poses have it. Zero where positions do not decide the rotation.
  Eigen::Matrix3d rotation_axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d rotation_sigma_rad = Eigen::Vector3d::Zero();
  /// Not empty: why it should not be trusted much.
  std::string warning;

  /// The scale applies to positions only, so the rotation stays one.
  Eigen::Affine3d operator*(const Eigen::Affine3d& pose) const;
};

/// Least squares of the estimate's positions onto the truth's. Throws EvaluationError if fewer
/// than two singular values of their covariance differ from zero: a single place, or a straight
/// line, leaves the rotation undetermined. Positions so far out that their squares are not finite
/// (a run that exploded) are left where they are, with a warning.
Alignment Umeyama(const std::vector<PosePair>& pairs, bool with_scale);

/// The root mean square of the distances between the estimate's positions, aligned, and the
/// truth's.
double AlignedRmse_m(const std::vector<PosePair>& pairs, const Alignment& alignment);

/// The largest standard deviation of the rotation; nothing if positions do not decide it.
std::optional<double> RotationSigmaDeg(const Alignment& alignment);

/// Throws EvaluationError if the alignment is undetermined.
Alignment ComputeAlignment(const std::vector<PosePair>& pairs, const AlignmentOptions& options);

}  // namespace trajlo
