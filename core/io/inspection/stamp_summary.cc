// SPDX-License-Identifier: MIT
#include "core/io/inspection/stamp_summary.h"

#include <algorithm>
#include <cmath>

#include "core/io/scan_stamps.h"
#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr double kGapInPeriods = 1.5;

/// Adds the step from `before_ns` to `now_ns`.
void AddStep(std::int64_t before_ns, std::int64_t now_ns, StampSummary* summary,
             std::vector<double>* deviations_s) {
  const std::int64_t step_ns = now_ns - before_ns;
  const double step_s = Seconds(step_ns);
  if (step_ns == 0) {
    ++summary->duplicates;
    if (!summary->first_duplicate_ns) summary->first_duplicate_ns = now_ns;
  } else if (step_ns < 0) {
    ++summary->steps_back;
    if (!summary->first_step_back_ns) summary->first_step_back_ns = now_ns;
    summary->largest_step_back_s = std::max(summary->largest_step_back_s, -step_s);
  } else if (step_s > kGapInPeriods * summary->period_s) {
    summary->gaps.push_back({before_ns, step_ns});
    summary->missing += static_cast<std::size_t>(std::llround(step_s / summary->period_s)) - 1;
  } else {
    deviations_s->push_back(step_s - summary->period_s);
  }
}

StampSummary::Delay DelayOf(const std::vector<std::int64_t>& stamps_ns,
                            const std::vector<std::int64_t>& recorded_ns) {
  std::vector<std::int64_t> delays_ns(stamps_ns.size());
  for (std::size_t i = 0; i < stamps_ns.size(); ++i) delays_ns[i] = recorded_ns[i] - stamps_ns[i];
  const auto [least, most] = std::minmax_element(delays_ns.begin(), delays_ns.end());
  return {Seconds(*least), Seconds(UpperMedian(delays_ns)), Seconds(*most)};
}

}  // namespace

StampSummary SummariseStamps(const std::vector<std::int64_t>& stamps_ns,
                             const std::vector<std::int64_t>& recorded_ns) {
  StampSummary summary;
  summary.count = stamps_ns.size();
  if (stamps_ns.empty()) return summary;
  summary.first_ns = stamps_ns.front();
  summary.last_ns = stamps_ns.back();
  summary.period_s = TypicalPeriod(stamps_ns);
  std::vector<double> deviations_s;
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    AddStep(stamps_ns[i - 1], stamps_ns[i], &summary, &deviations_s);
  }
  double sum = 0.0;
  for (const double deviation_s : deviations_s) {
    sum += deviation_s * deviation_s;
    summary.largest_deviation_s = std::max(summary.largest_deviation_s, std::abs(deviation_s));
  }
  if (!deviations_s.empty()) {
    summary.jitter_s = std::sqrt(sum / static_cast<double>(deviations_s.size()));
  }
  if (recorded_ns.size() == stamps_ns.size()) {
    summary.recorded_after_s = DelayOf(stamps_ns, recorded_ns);
  }
  return summary;
}

}  // namespace trajlo
