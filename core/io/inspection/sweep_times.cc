// SPDX-License-Identifier: MIT
#include "core/io/inspection/sweep_times.h"

#include <algorithm>
#include <cmath>

#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {}  // namespace

void SweepTimes::Add(const LidarScan& scan, std::size_t points_without_time) {
  points_without_time_ += points_without_time;
  std::optional<std::int64_t> begin_ns, end_ns;
  for (const LidarPoint& point : scan.points) {
    // Drivers write time 0 for directions without a return.
    const bool is_return = point.xyz_m.allFinite() && !point.xyz_m.isZero(0.0F);
    if (!is_return) continue;
    begin_ns = begin_ns ? std::min(*begin_ns, point.t_ns) : point.t_ns;
    end_ns = end_ns ? std::max(*end_ns, point.t_ns) : point.t_ns;
  }
  if (!begin_ns) return;
  has_times_ = has_times_ || scan.has_point_times;
  begins_ns_.push_back(*begin_ns);
  ends_ns_.push_back(*end_ns);
  stamps_ns_.push_back(scan.stamp_ns);
}

std::optional<SweepSummary> SweepTimes::Summarise(double period_s) const {
  if (!has_times_) return {};
  std::vector<std::int64_t> spans_ns, pauses_ns, after_first_ns, after_last_ns;
  for (std::size_t i = 0; i < begins_ns_.size(); ++i) {
    spans_ns.push_back(ends_ns_[i] - begins_ns_[i]);
    after_first_ns.push_back(stamps_ns_[i] - begins_ns_[i]);
    after_last_ns.push_back(stamps_ns_[i] - ends_ns_[i]);
    if (i == 0) continue;
    const double step_s = Seconds(begins_ns_[i] - begins_ns_[i - 1]);
    const bool are_neighbours = step_s > 0.5 * period_s && step_s < 1.5 * period_s;
    if (are_neighbours) pauses_ns.push_back(begins_ns_[i] - ends_ns_[i - 1]);
  }
  SweepSummary summary;
  summary.span_s = Seconds(UpperMedian(spans_ns));
  summary.pause_s = Seconds(UpperMedian(pauses_ns));
  summary.stamp_after_first_s = Seconds(UpperMedian(after_first_ns));
  summary.stamp_after_last_s = Seconds(UpperMedian(after_last_ns));
  summary.points_without_time = points_without_time_;
  return summary;
}

std::optional<SweepPhase> PhaseOf(const std::vector<std::int64_t>& begins_ns,
                                  const std::vector<std::int64_t>& first_lidar_begins_ns,
                                  double period_s) {
  if (begins_ns.empty() || first_lidar_begins_ns.empty() || !(period_s > 0.0)) return {};
  std::vector<std::int64_t> sorted = first_lidar_begins_ns;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> phases_s;
  for (const std::int64_t begin_ns : begins_ns) {
    const auto next = std::upper_bound(sorted.begin(), sorted.end(), begin_ns);
    if (next == sorted.begin()) continue;
    double phase_s = Seconds(begin_ns - *(next - 1));
    // Kept near the first: a phase about zero would otherwise flip between zero and the period.
    if (!phases_s.empty()) phase_s -= period_s * std::round((phase_s - phases_s[0]) / period_s);
    phases_s.push_back(phase_s);
  }
  if (phases_s.empty()) return {};
  const auto [least, most] = std::minmax_element(phases_s.begin(), phases_s.end());
  const double spread_s = *most - *least;
  const double median_s = UpperMedian(phases_s);
  return SweepPhase{median_s - period_s * std::floor(median_s / period_s), spread_s};
}

}  // namespace trajlo
