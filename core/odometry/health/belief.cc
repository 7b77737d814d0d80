// SPDX-License-Identifier: MIT
#include "core/odometry/health/belief.h"

#include <algorithm>

#include "core/odometry/health/agreement.h"
#include "core/odometry/health/condition.h"
#include "core/odometry/health/support.h"
#include "core/odometry/window/step_size.h"

namespace trajlo {
namespace {

/// What no carrier of a LiDAR does.
constexpr double kMaxCorrection_m = 3.0;
constexpr double kMaxCorrection_rad = 1.0;
constexpr double kMaxSpeed_m_s = 100.0;
constexpr double kMaxTurnRate_rad_s = 60.0;
/// A correction is the acceleration times Δt², and the errors of two velocities. In segments of
/// 0.03 s the errors are larger; where the scene is followed, both together stay below 0.1 m, half
/// of kOnPlane_m.
constexpr double kMaxAcceleration_m_s2 = 100.0;
/// A direction counts as degenerate if the points of a window hold it to a larger standard
/// deviation than this; in a well-spread scene it is 0.01 m.
constexpr double kDegenerate_m = 0.1;

}  // namespace

bool IsBelievable(const WindowStatistics& statistics, const Window& window) {
  for (int k = 0; k < window.size(); ++k) {
    const double duration_s = window.At(k).Duration_s();
    if (!IsWithinReach(window.Pose(k), window.Pose(k + 1), duration_s)) return false;
  }
  return statistics.is_finite && statistics.correction.translation_m <= kMaxCorrection_m &&
         statistics.correction.rotation_rad <= kMaxCorrection_rad;
}

bool HasJumped(const WindowStatistics& statistics, const Window& window) {
  const double duration_s = window.segments.back().Duration_s();
  return statistics.correction.translation_m >
         std::max(kOnPlane_m, kMaxAcceleration_m_s2 * duration_s * duration_s);
}

bool IsWithinReach(const SE3& T_world_begin, const SE3& T_world_end, double duration_s) {
  const StepSize step = MeasureStep(T_world_begin, T_world_end);
  return step.translation_m <= kMaxSpeed_m_s * duration_s &&
         step.rotation_rad <= kMaxTurnRate_rad_s * duration_s;
}

void Revert(const std::vector<SE3>& poses, Window* window) {
  window->SetPoses(poses);
  window->is_believed = false;
  for (Segment& segment : window->segments) segment.registration = {};
}

void Judge(const RegistrationOptions& registration, Window* window, WindowStatistics* statistics) {
  Segment& newest = window->segments.back();
  newest.spurious = SpuriousInformationOf(newest.points, window->Pose(window->size() - 1),
                                          newest.T_world_end, window->NoiseOf(newest));
  if (!window->is_believed) {
    statistics->flags |= kFlagReverted;
    statistics->agreement = AgreementOf(*window, newest).worst;
  } else if (!statistics->has_converged) {
    statistics->flags |= kFlagNotConverged;
  }
  if (window->is_believed && HasJumped(*statistics, *window)) statistics->flags |= kFlagJump;
  if (IsUnsupported(*window, newest)) statistics->flags |= kFlagNoPoints;
  const WindowCondition condition = ConditionOf(*window, registration);
  statistics->smallest_eigenvalue = condition.smallest_eigenvalue;
  statistics->weak_direction = condition.weak_direction;
  if (condition.smallest_eigenvalue * kDegenerate_m * kDegenerate_m < 1.0) {
    statistics->flags |= kFlagDegenerate;
  }
}

}  // namespace trajlo
