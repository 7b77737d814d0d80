// SPDX-License-Identifier: MIT
#include "core/scans/lidar_track.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

/// Scans that must go on from each other before a pause is believed.
constexpr std::size_t kConfirmPause = 3;
/// A scan that more of those behind it overtake did not come early: its stamp is wrong.
constexpr int kMostOvertaken = 2;
/// So few may come at one time.
constexpr std::size_t kFewPoints = 10;

void ExchangeTimes(HeldScan* a, HeldScan* b) {
  const std::int64_t to_b_ns = Difference(b->times.begin_ns, a->times.begin_ns);
  for (const auto& [held, shift_ns] : {std::pair(a, to_b_ns), std::pair(b, -to_b_ns)}) {
    RemoveStrays(held->times, &held->scan);
    ShiftTimes(shift_ns, &held->scan);
    held->times.begin_ns += shift_ns;
    held->times.end_ns += shift_ns;
    held->times.center_ns += shift_ns;
    held->is_exchanged = true;
  }
}

}  // namespace

void LidarTrack::NoteArrival(const LidarScan& scan, const ScanTimes& times, std::int64_t arrival) {
  newest_ns_ = times.begin_ns;
  newest_arrival_ = arrival;
  if (!scan.has_point_times || scan.points.size() < kFewPoints) return;
  ++(times.begin_ns == times.end_ns ? with_one_time_ : with_several_times_);
}

bool LidarTrack::GoesOn(const LidarScan& scan, const ScanTimes& times) const {
  return held_.empty() && clock_.has_started() &&
         clock_.IsNext(clock_.PlaceOf(scan, times).begin_ns);
}

bool LidarTrack::IsStuck(const LidarScan& scan, const ScanTimes& times) const {
  const bool goes_on =
      clock_.has_started() &&
      clock_.PlaceOf(scan, times).begin_ns > Sum(clock_.last().begin_ns, clock_.period_ns() / 2);
  return goes_on && memory_.Varies() && memory_.HasPoints(scan) && HasReturn(scan);
}

void LidarTrack::NoteAt(const ScanPlace& place, const LidarScan& scan, const ScanTimes& times) {
  if (!clock_.has_started()) first_ns_ = place.begin_ns;
  clock_.Note(scan, place);
  last_recorded_begin_ns_ = times.begin_ns;
  stands_still_ = false;
  memory_.Add(place.begin_ns, scan);
  ScanView view(scan);
  if (!scan.has_point_times && MayBeExchanged(view)) exchanged_ += 2;
  is_last_reordered_ = false;
  views_.push_back(std::move(view));
  if (views_.size() > 3) views_.pop_front();
}

void LidarTrack::Hold(HeldScan* held) {
  held->view = ScanView(held->scan);
  held_.push_back(held);
}

/// True if the scan goes on, at a steady period, from others that repeat times with new points: the
/// clock stepped back by less than what is held, and only seems to go on from the last scan.
bool LidarTrack::ComesFromBehind(std::size_t i) const {
  for (; i > 0; --i) {
    const HeldScan& before = *held_[i - 1];
    const std::int64_t step_ns = Difference(held_[i]->times.begin_ns, before.times.begin_ns);
    if (!clock_.IsPeriod(step_ns)) return false;
    const bool is_taken = memory_.HasTime(PlaceOf(before).begin_ns, clock_.period_ns() / 2);
    if (IsBehind(before) && is_taken && !memory_.HasPoints(before.scan)) return true;
  }
  return false;
}

void LidarTrack::Judge(const Others& others, bool is_final) {
  while (!held_.empty()) {
    if (!clock_.has_started()) {
      if (!Start(others, is_final)) return;
      continue;
    }
    if (HandOnNext() || GoOnFromAnchor(others, is_final)) continue;
    if (held_.size() < kMostHeld && !is_final) return;
    GiveUpOldest(others);
  }
}

std::int64_t LidarTrack::Ahead(const HeldScan& held) const {
  return Difference(PlaceOf(held).begin_ns, clock_.last().begin_ns);
}

/// Whether the scan begins before the last one, or so soon behind its begin that nearly all of the
/// sweep would have been measured twice: a clock that stepped back by a sweep leaves it there.
bool LidarTrack::IsBehind(const HeldScan& held) const {
  return Ahead(held) <= Difference(held.times.end_ns, held.times.begin_ns) / 10;
}

bool LidarTrack::IsPlausibleStep(const HeldScan& from, const HeldScan& to) const {
  const std::int64_t step_ns = Difference(to.times.begin_ns, from.times.begin_ns);
  return step_ns > 0 && step_ns >= clock_.period_ns() / 2 && step_ns <= clock_.longest_step_ns();
}

std::size_t LidarTrack::ChainLength(std::size_t first) const {
  std::size_t end = first + 1;
  while (end < held_.size() && IsPlausibleStep(*held_[end - 1], *held_[end])) ++end;
  return end - first;
}

bool LidarTrack::HandOnNext() {
  std::size_t next = held_.size();
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (Ahead(*held_[i]) <= 0) continue;
    if (next == held_.size() || Ahead(*held_[i]) < Ahead(*held_[next])) next = i;
  }
  if (next == held_.size()) return false;
  const ScanPlace place = PlaceOf(*held_[next]);
  if (!clock_.IsNext(place.begin_ns) || ComesFromBehind(next)) return false;
  const std::size_t first = FirstByView(next);
  if (first != next) ExchangeTimes(held_[first], held_[next]);
  HandOn(held_[first], ScanFate::kHandedOn, PlaceOf(*held_[first]));
  return true;
}

bool LidarTrack::GoOnFromAnchor(const Others& others, bool is_final) {
  std::size_t anchor = FindAnchor(others, is_final);
  if (anchor == held_.size()) {
    anchor = FindStep(others, is_final);
    if (anchor == held_.size()) return false;
    TakeBackStep(anchor, others);
  }
  HeldScan* held = held_[anchor];
  PlaceThoseBefore(*held);
  HandOn(held, ScanFate::kHandedOn, PlaceOf(*held));
  return true;
}

/// A scan that came before this one, does not lie before it, and that others go on from as well,
/// contradicts it: one of the two has a wrong stamp. It is this one
///   - if it is the same scan again;
///   - where none was lost: if only the other has its place by the order in which they came;
///   - where some were lost: if they have the same stamp, as a stamp can be a copy of one before,
///     not of one to come; or if only the other comes whole periods after the last scan.
std::size_t LidarTrack::InStep(std::size_t i) const {
  constexpr double kSame = 0.1, kClearlyLess = 0.1;
  const std::size_t next = i + 1;
  if (next == held_.size()) return i;
  const auto is_in_order = [&](std::size_t k) {
    return std::abs(PeriodsAhead(*held_[k]) - static_cast<double>(k + 1)) < 0.5;
  };
  const auto out_of_step = [](double periods) { return std::abs(periods - std::round(periods)); };
  const double ahead = PeriodsAhead(*held_[i]);
  for (std::size_t k = 0; k < i; ++k) {
    const double other = PeriodsAhead(*held_[k]);
    if (other < ahead || !IsPlausibleStep(*held_[k], *held_[next])) continue;
    const bool has_its_stamp = other - ahead < kSame;
    if (has_its_stamp && Fingerprint(held_[k]->scan) == Fingerprint(held_[i]->scan)) return k;
    if (is_in_order(next)) {
      if (is_in_order(k)) return k;
    } else if (has_its_stamp || out_of_step(other) < out_of_step(ahead) - kClearlyLess) {
      return k;
    }
  }
  return i;
}

/// The first scan of the same clock that others go on from; one past the end if there is none.
std::size_t LidarTrack::FindAnchor(const Others& others, bool is_final) const {
  const std::size_t confirm = is_final ? 2 : kConfirmPause;
  bool is_other_clock = false;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    // What goes on from a scan of another clock is of that one, too.
    if (is_other_clock && IsPlausibleStep(*held_[i - 1], *held_[i])) continue;
    is_other_clock = false;
    if (ChainLength(i) < confirm || ComesFromBehind(i)) continue;
    if (IsSameClock(i, others)) return InStep(i);
    is_other_clock = !IsBehind(*held_[i]);
  }
  if (!is_final) return held_.size();
  // The last scan may come a little late, but behind a pause its stamp may be wrong.
  const auto is_soon = [&](const HeldScan* held) {
    return Ahead(*held) > 0 && clock_.IsRoughlyPeriod(Ahead(*held));
  };
  return static_cast<std::size_t>(std::find_if(held_.begin(), held_.end(), is_soon) -
                                  held_.begin());
}

/// True if the stamps repeat for long.
bool LidarTrack::StandsStill() const {
  const std::size_t count = stands_still_ ? 1 : kConfirmPause;
  if (clock_.period_ns() == 0 || held_.size() < count) return false;
  return std::all_of(
      held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count), [&](const HeldScan* held) {
        return Distance(held->times.begin_ns, last_recorded_begin_ns_) <= clock_.period_ns() / 2;
      });
}

void LidarTrack::GiveUpOldest(const Others& others) {
  HeldScan* oldest = held_.front();
  const bool increases = held_.size() < 2 || held_[1]->times.begin_ns > oldest->times.begin_ns;
  if (held_.size() >= 2 && increases && IsSameClock(0, others)) {
    HandOn(oldest, ScanFate::kHandedOn, PlaceOf(*oldest));
    return;
  }
  if (!StandsStill() || memory_.HasPoints(oldest->scan)) {
    Drop(oldest);
    return;
  }
  const ScanPlace last = clock_.last();
  const std::int64_t recorded_ns = last_recorded_begin_ns_;
  HandOn(oldest, ScanFate::kAssumed,
         {last.begin_ns + clock_.period_ns(), last.stamp_ns + clock_.period_ns()});
  last_recorded_begin_ns_ = recorded_ns;
  stands_still_ = true;
}

void LidarTrack::HandOn(HeldScan* held, ScanFate fate, const ScanPlace& place) {
  NoteAt(place, held->scan, held->times);
  if (fate == ScanFate::kHandedOn && held->overtaken > 0) fate = ScanFate::kReordered;
  if (held->is_exchanged) fate = ScanFate::kRetimed;
  is_last_reordered_ = fate == ScanFate::kReordered;
  const std::int64_t arrival = held->arrival;
  Remove(held, fate, Difference(place.begin_ns, held->times.begin_ns));
  // Those that came before it are overtaken; for some it is too late now.
  const std::vector<HeldScan*> rest = held_;
  for (HeldScan* other : rest) {
    if (other->arrival > arrival) break;
    if (Ahead(*other) <= 0 || ++other->overtaken > kMostOvertaken) Drop(other);
  }
}

void LidarTrack::Drop(HeldScan* held) {
  const bool is_repeated =
      clock_.has_started() &&
      (memory_.HasPoints(held->scan) || Distance(PlaceOf(*held).begin_ns, clock_.last().begin_ns) <=
                                            clock_.period_ns() + clock_.period_ns() / 2);
  Remove(held, is_repeated ? ScanFate::kRepeated : ScanFate::kMisfit, 0);
}

void LidarTrack::Remove(HeldScan* held, ScanFate fate, std::int64_t shift_ns) {
  held_.erase(std::find(held_.begin(), held_.end(), held));
  judgements_.push_back({held, fate, shift_ns});
}

}  // namespace trajlo
