// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/evaluation/association.h"
#include "core/evaluation/timed_poses.h"

namespace trajlo {

/// How much of an estimate the pairs stand for: the time that lies between neighbouring pairs, and
/// the same of the estimate's own poses. A pause that is longer than a second and than ten usual
/// intervals belongs to neither. Sparse truth covers what lies between its poses.
struct Coverage {
  double pairs_s = 0.0;
  double estimate_s = 0.0;

  /// 1 without stamps, and for an estimate of no length.
  double Share() const;
};

/// `pairs` of Associate().
Coverage CoverageOf(const TimedPoses& estimate, const std::vector<PosePair>& pairs);

/// A warning if the pairs stand for less than half of the estimate; else empty.
std::string JudgeCoverage(const Coverage& coverage);

}  // namespace trajlo
