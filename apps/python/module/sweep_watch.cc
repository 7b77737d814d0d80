// SPDX-License-Identifier: MIT
#include "apps/python/module/sweep_watch.h"

#include <algorithm>

#include "core/io/format_text.h"
#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/scan_times.h"

namespace trajlo::python {
namespace {

constexpr std::size_t kScans = 10;
constexpr std::size_t kScansAtEnd = 3;

/// From the first to the last time of points, without a fiftieth at each end: a few wrong times do
/// not make another unit. Negative without points.
double Span_s(const LidarScan& scan) {
  std::vector<std::int64_t> times_ns;
  times_ns.reserve(scan.points.size());
  for (const LidarPoint& point : scan.points) {
    if (point.xyz_m.allFinite()) times_ns.push_back(point.t_ns);
  }
  if (times_ns.empty()) return -1.0;
  const auto left_out = static_cast<std::ptrdiff_t>(times_ns.size() / 50);
  const auto first = times_ns.begin() + left_out, last = times_ns.end() - 1 - left_out;
  std::nth_element(times_ns.begin(), first, times_ns.end());
  const std::int64_t first_ns = *first;
  std::nth_element(first, last, times_ns.end());
  return Seconds(Difference(*last, first_ns));
}

}  // namespace

void SweepWatch::Note(const LidarScan& scan) {
  Lidar& lidar = lidars_[scan.lidar_id];
  if (is_told_ || lidar.spans_s.size() >= kScans || !scan.has_point_times) return;
  const double span_s = Span_s(scan);
  if (span_s < 0.0) return;
  if (!lidar.spans_s.empty()) {
    const double period_s = Seconds(Difference(scan.stamp_ns, lidar.last_stamp_ns));
    if (period_s > 0.0) lidar.periods_s.push_back(period_s);
  }
  lidar.spans_s.push_back(span_s);
  lidar.last_stamp_ns = scan.stamp_ns;
}

std::string SweepWatch::TakeDoubt(bool at_end) {
  if (is_told_) return "";
  for (const auto& [id, lidar] : lidars_) {
    if (lidar.spans_s.size() < (at_end ? kScansAtEnd : kScans) || lidar.periods_s.empty()) continue;
    const double span_s = UpperMedian(lidar.spans_s);
    const double period_s = UpperMedian(lidar.periods_s);
    // The bounds of the commands, see DoubtOfUnit() in core/io/time_convention.cc.
    if (span_s >= 0.05 * period_s && span_s <= 5.0 * period_s) continue;
    is_told_ = true;
    if (span_s == 0.0) {
      return "all points of a scan have one time: right for motion-corrected scans only, others "
             "blur with every turn (the option input.point_time=none says that they are corrected)";
    }
    return FormatText(
        "the times of points make a sweep take %.3g s, but stamps are %.3g s apart (LiDAR %d): "
        "check their unit; times_s are seconds after the stamp, times_ns absolute nanoseconds",
        span_s, period_s, id);
  }
  return "";
}

}  // namespace trajlo::python
