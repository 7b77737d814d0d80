// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "core/evaluation/timed_poses.h"

namespace trajlo {

/// How poses of the estimate and of the truth are brought together in time.
///   kInterpolate          the truth is interpolated at every stamp of the estimate (positions
///                         linearly, rotations along the shortest arc); for truth that is denser
///                         than the motion, such as motion capture
///   kInterpolateEstimate  the estimate is interpolated at every stamp of the truth; for sparse
///                         truth, such as a total station
///   kNearest              evo's rule: nothing is interpolated; for each pose of the trajectory
///                         with fewer poses (the estimate if both have the same number) the
///                         nearest one of the other, the first of two that are equally near
///   kOneToOne             the rule of the TUM RGB-D benchmark's absolute error: nothing is
///                         interpolated; the closest pairs first, and no pose twice
/// Trajectories that both have no stamps are paired line by line, whatever the rule.
enum class AssociationRule { kInterpolate, kInterpolateEstimate, kNearest, kOneToOne };

struct PoseAssociationOptions {
  AssociationRule rule = AssociationRule::kInterpolate;
  /// kNearest and kOneToOne: pairs further apart are dropped. A difference of exactly this much is
  /// kept by the one and dropped by the other, as the tools do that define them.
  double max_time_difference_s = 0.01;
  /// Nothing is interpolated across a longer gap. 0: MaxGap() decides.
  double max_gap_s = 0.0;
};

/// A pose of the estimate with the truth at the same time.
struct PosePair {
  std::int64_t t_ns = 0;  ///< By the clock of the truth; the number of the line without stamps.
  /// Of the estimate, or of the truth with kInterpolateEstimate.
  std::size_t index = 0;
  Eigen::Affine3d estimate;
  Eigen::Affine3d truth;
};

/// The longest gap that is interpolated across: 2.5 times the typical interval of the stamps, but
/// at least 0.05 s.
double MaxGap(const std::vector<std::int64_t>& t_ns);

/// Forms the pairs after `time_offset_ns` has been added to the stamps of the estimate.
/// Throws EvaluationError if there is none, or if one of the two has no poses, or if only one of
/// them has stamps, or if neither has and the numbers of poses differ.
std::vector<PosePair> Associate(const TimedPoses& estimate, const TimedPoses& truth,
                                std::int64_t time_offset_ns, const PoseAssociationOptions& options);

}  // namespace trajlo
