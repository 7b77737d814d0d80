// SPDX-License-Identifier: MIT
#include "core/scans/scan_sequencer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// For each LiDAR, at most this many scans wait.
constexpr std::size_t kMostQueued = 16;
constexpr std::size_t kMostRemarks = 20;
/// LiDARs of one recording begin and end within this much, or not at the same distance.
constexpr std::int64_t kSmallShift_ns = 1'000'000'000;
/// A walker moves by three centimetres in this much time.
constexpr std::int64_t kLargeDrift_ns = 20'000'000;

std::string SecondsText(std::int64_t ns) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.3f s", Seconds(ns));
  return text;
}

/// What clocks differ by is not known to more than a sweep.
std::string Roughly(std::int64_t ns) {
  char text[40];
  std::snprintf(text, sizeof(text), "%+.1f s", Seconds(ns));
  return text;
}

bool IsDropped(ScanFate fate) {
  return fate == ScanFate::kMisfit || fate == ScanFate::kRepeated || fate == ScanFate::kApart;
}

void Count(const Judgement& judgement, TimeReport* report) {
  const ScanFate fate = judgement.fate;
  const bool is_as_recorded = fate == ScanFate::kHandedOn || fate == ScanFate::kReordered;
  report->moved += is_as_recorded && judgement.shift_ns != 0 ? 1 : 0;
  report->reordered += fate == ScanFate::kReordered ? 1 : 0;
  report->retimed += fate == ScanFate::kRetimed ? 1 : 0;
  report->assumed += fate == ScanFate::kAssumed ? 1 : 0;
  report->misfits += fate == ScanFate::kMisfit ? 1 : 0;
  report->repeated += fate == ScanFate::kRepeated ? 1 : 0;
  report->apart += fate == ScanFate::kApart ? 1 : 0;
}

std::string LidarName(std::size_t lidar) { return "lidar " + std::to_string(lidar); }

}  // namespace

ScanSequencer::ScanSequencer(double max_lag_s, HandOn hand_on)
    : max_lag_ns_(Nanoseconds(max_lag_s)), hand_on_(std::move(hand_on)) {}

void ScanSequencer::Add(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  if (!has_times_) first_lidar_ = lidar;
  if (lidar >= tracks_.size()) {
    tracks_.resize(lidar + 1);
    is_apart_.resize(lidar + 1, false);
    before_pose_.resize(lidar + 1);
    has_return_.resize(lidar + 1, false);
  }
  has_return_[lidar] = has_return_[lidar] || HasReturn(scan);
  const std::int64_t arrival = report_.scans++;
  report_.doubtful_end_s = 0.0;
  LidarTrack& track = tracks_[lidar];
  const auto times = MeasureTimes(scan, track.clock().usual_span_ns());
  if (!times) {  // Without points there is nothing to hand on.
    if (!scan.points.empty()) ++report_.misfits;
    report_.points += static_cast<std::int64_t>(scan.points.size());
    return;
  }
  has_times_ = true;
  track.NoteArrival(scan, *times, arrival);
  if (track.IsStuck(scan, *times)) {
    ++report_.stuck;
    report_.points += static_cast<std::int64_t>(scan.points.size());
    return;
  }
  const bool is_plain = times->strays == 0 && track.clock().offset_ns() == 0;
  if (queue_.empty() && is_plain && track.GoesOn(scan, *times)) {
    track.Note(scan, *times);
    Hand(scan, arrival);
    return;
  }
  queue_.push_back(std::make_unique<Entry>());
  HeldScan& held = queue_.back()->held;
  held.scan = scan;
  held.times = *times;
  held.arrival = arrival;
  held.reference_ns = tracks_[first_lidar_].newest_ns();
  track.Hold(&held);
  Judge(lidar, false);
  while (queue_.size() > kMostQueued * tracks_.size()) {
    Judge(static_cast<std::size_t>(queue_.front()->held.scan.lidar_id), true);
  }
}

void ScanSequencer::Finish() {
  while (!queue_.empty()) {
    Judge(static_cast<std::size_t>(queue_.front()->held.scan.lidar_id), true);
  }
  DoubtTheBegin();
  CompareSpans();
  NoteSilence();
  CompareDrifts();
  for (const LidarTrack& track : tracks_) {
    report_.exchanged += track.exchanged();
    report_.odd_point_times += track.odd_point_times();
  }
}

void ScanSequencer::Judge(std::size_t lidar, bool is_final) {
  LidarTrack::Others others;
  if (lidar != first_lidar_) others.reference = &tracks_[first_lidar_];
  others.max_lag_ns = max_lag_ns_;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (i != lidar && tracks_[i].clock().has_started()) others.started.push_back(&tracks_[i]);
  }
  LidarTrack& track = tracks_[lidar];
  track.Judge(others, is_final);
  for (const Judgement& judgement : track.TakeJudgements()) Apply(judgement);
  Describe(lidar);
  Release();
}

void ScanSequencer::Apply(const Judgement& judgement) {
  const auto of_lidar = [&](const auto& entry) {
    return !entry->is_judged && entry->held.scan.lidar_id == judgement.held->scan.lidar_id;
  };
  const auto entry = std::find_if(queue_.begin(), queue_.end(), [&](const auto& other) {
    return &other->held == judgement.held;
  });
  Count(judgement, &report_);
  if (judgement.fate == ScanFate::kMisfit) {
    DoubtTheEnd(*judgement.held);
    if (judgement.held->arrival == 0) dropped_first_ns_ = judgement.held->times.begin_ns;
  }
  if (IsDropped(judgement.fate)) {
    report_.points += static_cast<std::int64_t>(judgement.held->scan.points.size());
    queue_.erase(entry);
    return;
  }
  (*entry)->is_judged = true;
  (*entry)->shift_ns = judgement.shift_ns;
  report_.points += static_cast<std::int64_t>(judgement.held->times.strays);
  // It comes before those of its LiDAR that it overtook.
  const auto place = std::find_if(queue_.begin(), entry, of_lidar);
  std::rotate(place, entry, entry + 1);
}

/// A last scan that is dropped has a wrong stamp, or is the only sign that the recording goes on.
void ScanSequencer::DoubtTheEnd(const HeldScan& dropped) {
  const LidarClock& clock = tracks_[static_cast<std::size_t>(dropped.scan.lidar_id)].clock();
  if (dropped.arrival + 1 < report_.scans || !clock.has_started()) return;
  const auto begin_ns = static_cast<double>(clock.PlaceOf(dropped.scan, dropped.times).begin_ns);
  const double ahead_s = 1e-9 * (begin_ns - static_cast<double>(clock.last().begin_ns));
  report_.doubtful_end_s = std::max(0.0, ahead_s);
}

/// So has a first scan that is dropped, or it is the only sign that the recording began before. Too
/// long before, its stamp is wrong.
void ScanSequencer::DoubtTheBegin() {
  if (!dropped_first_ns_ || !tracks_[first_lidar_].clock().has_started()) return;
  const std::int64_t before_ns = Difference(tracks_[first_lidar_].first_ns(), *dropped_first_ns_);
  if (before_ns > LidarTrack::kLongestPause_ns) return;
  report_.doubtful_begin_s = std::max(0.0, Seconds(before_ns));
}

void ScanSequencer::Release() {
  while (!queue_.empty() && queue_.front()->is_judged) {
    // Taken out first: a scan whose receiver throws is not handed on, and moved, once more.
    const std::unique_ptr<Entry> front = std::move(queue_.front());
    queue_.pop_front();
    RemoveStrays(front->held.times, &front->held.scan);
    ShiftTimes(front->shift_ns, &front->held.scan);
    Hand(front->held.scan, front->held.arrival);
  }
}

void ScanSequencer::Hand(const LidarScan& scan, std::int64_t arrival) {
  handed_on_arrival_ = arrival;
  if (!has_pose_) {
    // The stamp may mark the end of the sweep.
    std::int64_t begin_ns = scan.points.empty() ? scan.stamp_ns : scan.points.front().t_ns;
    for (const LidarPoint& point : scan.points) begin_ns = std::min(begin_ns, point.t_ns);
    before_pose_[static_cast<std::size_t>(scan.lidar_id)].push_back({begin_ns, arrival});
  }
  hand_on_(scan);
}

void ScanSequencer::NoteFirstPose(std::int64_t t_ns) {
  if (std::exchange(has_pose_, true)) return;
  std::int64_t first = handed_on_arrival_;
  for (const std::vector<Sweep>& sweeps : std::exchange(before_pose_, {})) {
    const auto behind = std::find_if(sweeps.begin(), sweeps.end(),
                                     [&](const Sweep& sweep) { return sweep.begin_ns > t_ns; });
    if (behind != sweeps.begin()) first = std::min(first, std::prev(behind)->arrival);
  }
  report_.before_first_pose = first;
}

void ScanSequencer::Describe(std::size_t lidar) {
  if (const auto step = tracks_[lidar].TakeStep()) {
    ++report_.clock_steps;
    const bool is_ahead = step->length_ns > 0;
    Remark(LidarName(lidar) + ": its clock steps " + (is_ahead ? "ahead" : "back") + " by " +
           SecondsText(is_ahead ? step->length_ns : -step->length_ns) + ", to " +
           SecondsText(step->at_ns) +
           (step->is_true_behind ? "; the times before were moved so that these go on from them"
                                 : "; the times from there on are moved so that they go on from "
                                   "those before"));
  }
  const auto apart = tracks_[lidar].TakeApart();
  if (!apart || is_apart_[lidar]) return;
  is_apart_[lidar] = true;
  const std::string how_far =
      SecondsText(std::abs(apart->ahead_ns)) + (apart->ahead_ns > 0 ? " ahead of" : " behind");
  const std::string first = LidarName(first_lidar_);
  std::string sentence = LidarName(lidar) + ": its times are " + how_far + " those of " + first;
  if (apart->never_together) sentence += ", which was silent by then";
  sentence += "; its scans are left out. If the clocks differ, change input.clock_offset_s";
  if (!apart->never_together) {
    sentence += " of this LiDAR by about " + Roughly(-apart->ahead_ns) +
                "; if its messages only come late, raise expert.segmenter.max_lag_s";
  }
  Remark(sentence);
}

/// LiDARs of folders are merged by their stamps, so that a wrong clock only shows at the ends: one
/// that begins later than the other and ends as much later.
void ScanSequencer::CompareSpans() {
  if (tracks_.empty() || !tracks_[first_lidar_].clock().has_started()) return;
  const LidarTrack& first = tracks_[first_lidar_];
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const LidarClock& clock = tracks_[i].clock();
    if (i == first_lidar_ || !clock.has_started()) continue;
    const std::int64_t begin_ns = tracks_[i].first_ns() - first.first_ns();
    const std::int64_t end_ns = clock.last().begin_ns - first.clock().last().begin_ns;
    const std::int64_t periods_ns = clock.period_ns() + first.clock().period_ns();
    const bool is_shifted = std::abs(begin_ns) > std::max(kSmallShift_ns, 3 * periods_ns);
    if (!is_shifted || std::abs(begin_ns - end_ns) > periods_ns + kSmallShift_ns / 10) continue;
    report_.clocks_may_differ = true;
    Remark(LidarName(i) + ": it begins " + SecondsText(begin_ns) + " after " +
           LidarName(first_lidar_) + " and ends " + SecondsText(end_ns) +
           " after it: if both recorded at the same time, their clocks differ, and "
           "input.clock_offset_s of one must be set");
  }
}

/// One that is never heard, or begins late, or ends early, where no shifted clock explains that.
void ScanSequencer::NoteSilence() {
  std::int64_t begin_ns = std::numeric_limits<std::int64_t>::max(), end_ns = -begin_ns;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!has_return_[i] || !tracks_[i].clock().has_started()) continue;
    begin_ns = std::min(begin_ns, tracks_[i].first_ns());
    end_ns = std::max(end_ns, tracks_[i].clock().last().begin_ns);
  }
  const auto note = [&](std::size_t lidar, const char* when, std::int64_t silent_ns) {
    if (silent_ns <= kSmallShift_ns && has_return_[lidar]) return;
    report_.longest_silence_s = std::max(report_.longest_silence_s, Seconds(silent_ns));
    Remark(LidarName(lidar) + ": nothing was heard of it for the " + when + " " +
           SecondsText(silent_ns));
  };
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!has_return_[i] && end_ns > begin_ns) note(i, "whole", end_ns - begin_ns);
    if (!has_return_[i] || report_.clocks_may_differ || !tracks_[i].clock().has_started()) continue;
    note(i, "first", tracks_[i].first_ns() - begin_ns);
    note(i, "last", end_ns - tracks_[i].clock().last().begin_ns);
  }
}

/// LiDARs that are not synchronised run apart, which the times of recording show.
void ScanSequencer::CompareDrifts() {
  if (tracks_.empty()) return;
  const auto first_ns = tracks_[first_lidar_].clock().Drift();
  for (std::size_t i = 0; first_ns && i < tracks_.size(); ++i) {
    const auto drift_ns = tracks_[i].clock().Drift();
    if (!drift_ns || Distance(*drift_ns, *first_ns) < kLargeDrift_ns) continue;
    report_.clocks_may_differ = true;
    Remark(LidarName(i) + ": by the times of recording, its clock and that of " +
           LidarName(first_lidar_) + " run apart, by " +
           SecondsText(Distance(*drift_ns, *first_ns)) +
           " in this recording: the LiDARs must be synchronised");
  }
}

void ScanSequencer::Remark(const std::string& sentence) {
  if (report_.remarks.size() < kMostRemarks) report_.remarks.push_back(sentence);
}

}  // namespace trajlo
