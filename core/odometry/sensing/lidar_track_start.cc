// SPDX-License-Identifier: MIT
// The first scans of a LiDAR: its period, and whether its clock is that of the others.
#include <algorithm>

#include "core/odometry/sensing/lidar_track.h"

namespace trajlo {
namespace {

/// So many scans show the period, in spite of one with a wrong stamp.
constexpr std::size_t kHeldAtStart = 5;

}  // namespace

/// Nothing is handed on until two scans go on from each other.
bool LidarTrack::Start(const Others& others, bool is_final) {
  if (held_.size() < kHeldAtStart && !is_final) return false;
  std::vector<std::int64_t> begins_ns, spans_ns;
  for (const HeldScan* held : held_) {
    begins_ns.push_back(held->times.begin_ns);
    spans_ns.push_back(held->times.end_ns - held->times.begin_ns);
  }
  clock_.GuessPeriod(begins_ns, spans_ns);
  if (others.reference != nullptr && !FindOffset(others)) {
    while (!held_.empty()) Remove(held_.front(), ScanFate::kApart, 0);
    return true;
  }
  std::size_t first = FirstOfChain();
  if (first == held_.size()) {
    if (held_.size() < kMostHeld && !is_final) return false;
    const bool all_equal = std::all_of(held_.begin(), held_.end(), [&](const HeldScan* held) {
      return held->times.begin_ns == begins_ns.front();
    });
    if (!all_equal && !is_final) {
      Drop(held_.front());
      return true;
    }
    first = 0;
  }
  HandOn(held_[first], ScanFate::kHandedOn, PlaceOf(*held_[first]));
  return true;
}

/// Whether the times meet those of the first LiDAR, and if so, by which offset.
bool LidarTrack::FindOffset(const Others& others) {
  const LidarClock& reference = others.reference->clock();
  std::vector<std::int64_t> ahead_ns;
  for (const HeldScan* held : held_) {
    ahead_ns.push_back(Difference(held->times.begin_ns, held->reference_ns));
  }
  const std::int64_t median_ns = *LowerMedian(ahead_ns);
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

/// The first scan that others go on from; one past the end if there is none.
std::size_t LidarTrack::FirstOfChain() const {
  std::size_t first = 0;
  while (first < held_.size() && ChainLength(first) < 2) ++first;
  if (first == held_.size()) return first;
  const auto follows = [&](std::size_t i) {
    const std::int64_t step_ns = Difference(held_[i]->times.begin_ns, held_[i - 1]->times.begin_ns);
    return step_ns > 0 && step_ns <= clock_.longest_step_ns();
  };
  while (first > 0 && follows(first)) --first;
  return first;
}

}  // namespace trajlo
