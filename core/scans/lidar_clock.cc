// SPDX-License-Identifier: MIT
#include "core/scans/lidar_clock.h"

#include <algorithm>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Recorders write at once, or a little later when they are busy.
constexpr std::int64_t kDelayTolerance_ns = kNsPerSecond;
/// Closer than this, a time of recording is a copy of the stamp: no recorder is so fast.
constexpr std::int64_t kCopy_ns = 20'000;
/// Until this many steps are known, the guess at the start holds.
constexpr std::size_t kStepsForPeriod = 5;
constexpr std::size_t kRemembered = 16;
/// A LiDAR that is slower is none.
constexpr std::int64_t kLongestPeriod_ns = 10 * kNsPerSecond;

}  // namespace

std::int64_t LidarClock::longest_step_ns() const { return std::max(kNsPerSecond, 3 * period_ns_); }

std::int64_t LidarClock::usual_span_ns() const {
  return period_ns_ > 0 ? 2 * period_ns_ : kNsPerSecond;
}

ScanPlace LidarClock::PlaceOf(const LidarScan& scan, const ScanTimes& times) const {
  return {Sum(times.begin_ns, offset_ns_), Sum(scan.stamp_ns, offset_ns_)};
}

bool LidarClock::IsPeriod(std::int64_t step_ns) const {
  return period_ns_ > 0 && step_ns >= period_ns_ / 2 && step_ns <= period_ns_ + period_ns_ / 2;
}

bool LidarClock::IsRoughlyPeriod(std::int64_t step_ns) const {
  return Distance(step_ns, period_ns_) <= period_ns_ + period_ns_ / 2;
}

bool LidarClock::IsNext(std::int64_t begin_ns) const {
  return IsPeriod(Difference(begin_ns, last_->begin_ns));
}

std::optional<bool> LidarClock::DoRecordTimesAgree(const LidarScan& scan,
                                                   const ScanPlace& place) const {
  if (!scan.recorded_ns || copies_stamps_ || recorded_.size() < kStepsForPeriod) {
    return std::nullopt;
  }
  std::vector<std::int64_t> delays_ns;
  for (const Recorded& recorded : recorded_) delays_ns.push_back(recorded.delay_ns);
  const auto [least, most] = std::minmax_element(delays_ns.begin(), delays_ns.end());
  // A clock of the recorder that does not run with that of the LiDAR tells nothing either.
  const std::int64_t span_ns = Difference(recorded_.back().begin_ns, recorded_.front().begin_ns);
  if (Difference(*most, *least) > span_ns / 2) return std::nullopt;
  const std::int64_t delay_ns = Difference(*scan.recorded_ns, place.begin_ns);
  const std::int64_t change_ns = Difference(delay_ns, LowerMedian(delays_ns));
  return change_ns <= kDelayTolerance_ns && change_ns >= -kDelayTolerance_ns;
}

std::optional<std::int64_t> LidarClock::Drift() const {
  if (copies_stamps_ || first_delays_ns_.size() < kRemembered) return std::nullopt;
  std::vector<std::int64_t> last_delays_ns;
  for (const Recorded& recorded : recorded_) last_delays_ns.push_back(recorded.stamp_delay_ns);
  return Difference(LowerMedian(last_delays_ns), LowerMedian(first_delays_ns_));
}

void LidarClock::GuessPeriod(std::vector<std::int64_t> begins_ns,
                             const std::vector<std::int64_t>& spans_ns) {
  // In order, so that scans that were swapped do not hide it; one wrong stamp adds one wrong step.
  std::sort(begins_ns.begin(), begins_ns.end());
  std::vector<std::int64_t> steps_ns;
  for (std::size_t i = 1; i < begins_ns.size(); ++i) {
    const std::int64_t step_ns = Difference(begins_ns[i], begins_ns[i - 1]);
    if (step_ns > 0) steps_ns.push_back(step_ns);
  }
  period_ns_ = LowerMedian(steps_ns);
  // Stamps that stand still: sweeps follow each other.
  const bool is_known = period_ns_ > 0 && period_ns_ <= kLongestPeriod_ns;
  if (!is_known) period_ns_ = std::min(LowerMedian(spans_ns), kLongestPeriod_ns);
}

void LidarClock::Note(const LidarScan& scan, const ScanPlace& place) {
  if (last_) {
    const std::int64_t step_ns = Difference(place.begin_ns, last_->begin_ns);
    if (step_ns > 0 && step_ns <= longest_step_ns()) steps_ns_.Add(step_ns);
    if (steps_ns_.size() >= kStepsForPeriod) period_ns_ = *steps_ns_.Value();
  }
  if (scan.recorded_ns) {
    const std::int64_t stamp_delay_ns = Difference(*scan.recorded_ns, place.stamp_ns);
    recorded_.push_back(
        {place.begin_ns, Difference(*scan.recorded_ns, place.begin_ns), stamp_delay_ns});
    if (recorded_.size() > kRemembered) recorded_.pop_front();
    if (first_delays_ns_.size() < kRemembered) first_delays_ns_.push_back(stamp_delay_ns);
    const std::int64_t after_stamp_ns = Difference(*scan.recorded_ns, scan.stamp_ns);
    const bool is_copy = after_stamp_ns <= kCopy_ns && after_stamp_ns >= -kCopy_ns;
    copies_stamps_ = copies_stamps_ && is_copy;
  }
  last_ = place;
}

}  // namespace trajlo
