// SPDX-License-Identifier: MIT
// The first scans of a LiDAR: its period, and whether its clock is that of the others.
#include <algorithm>

#include "core/scans/lidar_track.h"

namespace trajlo {
namespace {

/// This many scans show the period, in spite of one with a wrong stamp; ...
constexpr std::size_t kHeldAtStart = 5;
/// ... but where no three of them come at an even pace, this many are awaited.
constexpr std::size_t kMostHeldAtStart = 12;
/// This many go on from each other behind a step of the clock.
constexpr std::size_t kBehindStep = 5;

}  // namespace

/// Nothing is handed on until two scans go on from each other.
bool LidarTrack::Start(const Others& others, bool is_final) {
  const std::vector<std::int64_t> even_ns = EvenPace();
  const std::size_t needed = even_ns.empty() ? kMostHeldAtStart : kHeldAtStart;
  if (held_.size() < needed && !is_final) return false;
  std::vector<std::int64_t> begins_ns, spans_ns;
  for (const HeldScan* held : held_) {
    begins_ns.push_back(held->times.begin_ns);
    spans_ns.push_back(held->times.end_ns - held->times.begin_ns);
  }
  clock_.GuessPeriod(even_ns.empty() ? begins_ns : even_ns, spans_ns);
  if (others.reference != nullptr && !FindOffset(others)) {
    while (!held_.empty()) Remove(held_.front(), ScanFate::kApart, 0);
    return true;
  }
  std::size_t first = FirstOfChain();
  if (first == held_.size()) {
    if (held_.size() < kMostHeldAtStart && !is_final) return false;
    const bool all_equal = std::all_of(held_.begin(), held_.end(), [&](const HeldScan* held) {
      return held->times.begin_ns == begins_ns.front();
    });
    if (!all_equal && !is_final) {
      Drop(held_.front());
      return true;
    }
    first = 0;
  }
  if (others.reference == nullptr && !is_final && !SetBackForAStep(first)) return false;
  HandOn(held_[first], ScanFate::kHandedOn, PlaceOf(*held_[first]));
  return true;
}

/// The times of three scans in a row that come at an even pace, if there are such.
std::vector<std::int64_t> LidarTrack::EvenPace() const {
  std::vector<std::int64_t> best;
  for (std::size_t i = 2; i < held_.size(); ++i) {
    const std::vector<std::int64_t> three = {
        held_[i - 2]->times.begin_ns, held_[i - 1]->times.begin_ns, held_[i]->times.begin_ns};
    const std::int64_t before_ns = Difference(three[1], three[0]);
    const std::int64_t step_ns = Difference(three[2], three[1]);
    if (step_ns <= 0 || Distance(step_ns, before_ns) >= step_ns / 4) continue;
    // Where scans were lost, the shorter pace is the true one.
    if (best.empty() || step_ns < Difference(best[1], best[0])) best = three;
  }
  return best;
}

/// Whether the times meet those of the first LiDAR, and if so, by which offset.
bool LidarTrack::FindOffset(const Others& others) {
  const LidarClock& reference = others.reference->clock();
  std::vector<std::int64_t> ahead_ns;
  for (const HeldScan* held : held_) {
    ahead_ns.push_back(Difference(held->times.begin_ns, held->reference_ns));
  }
  const std::int64_t median_ns = LowerMedian(ahead_ns);
  const std::int64_t bound_ns = others.max_lag_ns + clock_.period_ns() + reference.period_ns();
  // If the times as they were recorded meet, they are of one clock.
  const bool is_same_clock = Distance(median_ns, 0) <= bound_ns;
  if (!is_same_clock && Distance(median_ns, reference.offset_ns()) > bound_ns) {
    apart_ = Apart{median_ns, held_.front()->reference_ns == held_.back()->reference_ns};
    return false;
  }
  clock_.set_offset_ns(is_same_clock ? reference.offset_ns() : 0);
  return true;
}

/// Where the clock was set behind the first few scans, theirs is the wrong time: they are moved to
/// lie before the others. False if that is not known yet.
bool LidarTrack::SetBackForAStep(std::size_t first) {
  const std::size_t step = first + ChainLength(first);
  if (step >= held_.size()) return true;
  const HeldScan& before = *held_[step - 1];
  const std::int64_t ahead_ns = Difference(held_[step]->times.begin_ns, before.times.begin_ns);
  const bool is_late = ahead_ns <= 0 && ahead_ns >= -clock_.longest_step_ns();
  if (is_late || (ahead_ns > 0 && ahead_ns <= kLongestPause_ns)) return true;
  if (ChainLength(step) < kBehindStep) return held_.size() >= kMostHeldAtStart;
  clock_.set_offset_ns(Difference(ahead_ns, clock_.period_ns()));
  return true;
}

/// The first scan that others go on from; one past the end if there is none.
std::size_t LidarTrack::FirstOfChain() const {
  std::size_t first = 0;
  while (first < held_.size() && !IsInPace(first)) ++first;
  if (first == held_.size()) {
    first = 0;
    while (first < held_.size() && ChainLength(first) < 2) ++first;
    return first;
  }
  // Scans may be swapped.
  for (std::size_t i = first + 1; i < held_.size(); ++i) {
    const std::int64_t ahead_ns =
        Difference(held_[first]->times.begin_ns, held_[i]->times.begin_ns);
    if (ahead_ns > 0 && clock_.IsRoughlyPeriod(ahead_ns) && IsInPace(i)) first = i;
  }
  return first;
}

/// True if another scan lies as far from this one in time as in the order in which they came. A
/// lone scan before a pause may have a wrong stamp, and is no great loss.
bool LidarTrack::IsInPace(std::size_t i) const {
  for (std::size_t k = i + 1; k < held_.size(); ++k) {
    const auto periods = static_cast<std::int64_t>(k - i);
    const std::int64_t step_ns = Difference(held_[k]->times.begin_ns, held_[i]->times.begin_ns);
    if (step_ns <= 0) continue;
    if (clock_.IsRoughlyPeriod(step_ns - (periods - 1) * clock_.period_ns())) return true;
  }
  return false;
}

}  // namespace trajlo
