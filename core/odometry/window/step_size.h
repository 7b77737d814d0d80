// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// How far control poses moved, at most.
struct StepSize {
  double translation_m = 0.0;
  double rotation_rad = 0.0;

  bool IsWithin(const StepSize& tolerance) const {
    return translation_m < tolerance.translation_m && rotation_rad < tolerance.rotation_rad;
  }
};

inline StepSize MeasureStep(const SE3& start, const SE3& end) {
  const SE3 step = start.Inverse() * end;
  return {step.t.norm(), so3::Log(step.q).norm()};
}

inline StepSize MeasureStep(const std::vector<SE3>& start, const std::vector<SE3>& end) {
  StepSize largest;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const StepSize step = MeasureStep(start[i], end[i]);
    largest.translation_m = std::max(largest.translation_m, step.translation_m);
    largest.rotation_rad = std::max(largest.rotation_rad, step.rotation_rad);
  }
  return largest;
}

/// Whether both control poses of a segment are within `tolerance` of others.
inline bool AreNear(const SE3& begin, const SE3& end, const SE3& other_begin, const SE3& other_end,
                    const StepSize& tolerance) {
  return MeasureStep(begin, other_begin).IsWithin(tolerance) &&
         MeasureStep(end, other_end).IsWithin(tolerance);
}

}  // namespace trajlo
