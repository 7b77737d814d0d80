// SPDX-License-Identifier: MIT
// Pauses are told from steps of the clock, and steps are taken back.
#include <algorithm>

#include "core/scans/lidar_track.h"

namespace trajlo {
namespace {

/// Scans that must go on from each other before a step of the clock is believed.
constexpr std::size_t kConfirmStep = 5;

}  // namespace

/// Whether the time between the last scan and this one really passed.
bool LidarTrack::DidTimePass(std::size_t i, const Others& others) const {
  const HeldScan& held = *held_[i];
  const ScanPlace place = PlaceOf(held);
  if (const auto agree = clock_.DoRecordTimesAgree(held.scan, place)) return *agree;
  bool others_say_no = IsNextByView(i);
  for (const LidarTrack* other : others.started) {
    const std::int64_t now_ns = Sum(other->newest_ns_, other->clock_.offset_ns());
    const std::int64_t to_this_ns = Distance(now_ns, place.begin_ns);
    if (to_this_ns <= clock_.longest_step_ns()) return true;
    const bool spoke_since = other->newest_arrival_ > held.arrival;
    if (spoke_since && Distance(now_ns, clock_.last().begin_ns) < to_this_ns) others_say_no = true;
  }
  return !others_say_no && Ahead(held) <= kLongestPause_ns;
}

/// Whether the scan would come next if the clock had never stepped: it went back to where it was. A
/// pause is hardly ever as long as the step.
bool LidarTrack::IsBackOnTime(const HeldScan& held) const {
  return clock_.offset_ns() != 0 && clock_.IsNext(held.times.begin_ns);
}

bool LidarTrack::IsSameClock(std::size_t i, const Others& others) const {
  if (IsBehind(*held_[i]) || IsBackOnTime(*held_[i])) return false;
  const std::int64_t ahead_ns = Ahead(*held_[i]);
  // Times of recording do not tell of so little time. Where there are other LiDARs, the views of
  // one alone are not asked.
  if (ahead_ns <= clock_.longest_step_ns()) return !others.started.empty() || !IsNextByView(i);
  return DidTimePass(i, others);
}

std::size_t LidarTrack::FindStep(const Others& others, bool is_final) const {
  const std::size_t confirm = is_final ? 2 : kConfirmStep;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (ChainLength(i) >= confirm && !IsSameClock(i, others)) return i;
  }
  return held_.size();
}

/// Moves the clock so that the anchor comes as many periods after the last scan as scans have come.
void LidarTrack::TakeBackStep(std::size_t anchor, const Others& others) {
  const HeldScan& held = *held_[anchor];
  const ScanPlace last = clock_.last();
  std::int64_t period_ns = clock_.period_ns();
  if (period_ns == 0) {
    period_ns = Difference(held_[anchor + 1]->times.begin_ns, held.times.begin_ns);
  }
  const std::int64_t wait_ns = static_cast<std::int64_t>(anchor + 1) * period_ns;
  // The first points of a scan may be missing; its stamp is exact, if it is one of these points.
  const std::int64_t by_begin_ns = Difference(Sum(last.begin_ns, wait_ns), held.times.begin_ns);
  const std::int64_t by_stamp_ns = Difference(Sum(last.stamp_ns, wait_ns), held.scan.stamp_ns);
  const bool stamp_fits = Distance(by_begin_ns, by_stamp_ns) <= period_ns / 2;
  std::int64_t offset_ns = stamp_fits ? by_stamp_ns : by_begin_ns;
  // A clock that steps together with another, or back to where it was, is exactly there.
  std::vector<std::int64_t> known_ns = {0};
  for (const LidarTrack* other : others.started) known_ns.push_back(other->clock_.offset_ns());
  for (const std::int64_t known : known_ns) {
    const bool goes_on = Sum(held.times.begin_ns, known) > last.begin_ns;
    if (goes_on && Distance(known, offset_ns) <= period_ns / 2) offset_ns = known;
  }
  step_ = Step{held.times.begin_ns, Difference(clock_.offset_ns(), offset_ns), offset_ns == 0};
  clock_.set_offset_ns(offset_ns);
}

}  // namespace trajlo
