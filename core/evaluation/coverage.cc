// SPDX-License-Identifier: MIT
#include "core/evaluation/coverage.h"

#include <algorithm>
#include <cstdint>

#include "core/io/format_text.h"
#include "core/io/scan_stamps.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr double kShortestPause_s = 1.0;
constexpr double kIntervalsOfPause = 10.0;
/// Truth that begins a little later, or ends a little earlier, is usual. Errors of a smaller part
/// are not those of the run.
constexpr double kLeastShare = 0.5;

/// The time that ordered stamps span, without the pauses.
double CoveredTime(const std::vector<std::int64_t>& t_ns) {
  const double pause_s = std::max(kShortestPause_s, kIntervalsOfPause * TypicalPeriod(t_ns));
  double sum_s = 0.0;
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    const double gap_s = Seconds(t_ns[i] - t_ns[i - 1]);
    if (gap_s <= pause_s) sum_s += gap_s;
  }
  return sum_s;
}

}  // namespace

double Coverage::Share() const {
  return estimate_s > 0.0 ? std::min(1.0, pairs_s / estimate_s) : 1.0;
}

Coverage CoverageOf(const TimedPoses& estimate, const std::vector<PosePair>& pairs) {
  if (!estimate.HasStamps()) return {};
  std::vector<std::int64_t> t_ns;
  for (const PosePair& pair : pairs) t_ns.push_back(pair.t_ns);
  std::sort(t_ns.begin(), t_ns.end());
  return {CoveredTime(t_ns), CoveredTime(estimate.t_ns)};
}

std::string JudgeCoverage(const Coverage& coverage) {
  if (coverage.Share() >= kLeastShare) return "";
  return FormatText(
      "only %.1f s of the %.1f s of the estimate could be compared with the ground truth, and the "
      "errors are those of that part",
      coverage.pairs_s, coverage.estimate_s);
}

}  // namespace trajlo
