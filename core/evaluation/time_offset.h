// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/evaluation/association.h"
#include "core/evaluation/timed_poses.h"

namespace trajlo {

struct TimeOffsetOptions {
  /// The middle of the search and its reach to both sides.
  double around_s = 0.0;
  double reach_s = 0.5;
  /// How poses are brought together. Rules that interpolate nothing have errors that jump with the
  /// offset: the truth is interpolated in their place.
  PoseAssociationOptions association;
  /// Scale is aligned, too.
  bool with_scale = false;
};

struct TimeOffset {
  /// To be added to the stamps of the estimate.
  double offset_s = 0.0;
  /// The rmse of the positions after alignment, there and at `around_s` (infinite if nothing can
  /// be compared there).
  double rmse_m = 0.0;
  double rmse_around_m = 0.0;
  /// Not empty: why it should not be believed.
  std::string warning;
};

/// Finds the offset between the clocks of estimate and truth that minimises the absolute position
/// error after Umeyama's alignment: a grid of steps of at most 0.02 s, then a golden section
/// search to 10 us around the best one. Offsets that lose more than a fifth of the pairs are not
/// considered. Both must have stamps and describe the same frame.
/// Throws EvaluationError if nothing can be compared anywhere in the range.
TimeOffset EstimateTimeOffset(const TimedPoses& estimate, const TimedPoses& truth,
                              const TimeOffsetOptions& options);

}  // namespace trajlo
