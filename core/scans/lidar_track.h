// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "core/scans/lidar_clock.h"
#include "core/scans/lidar_scan.h"
#include "core/scans/scan_memory.h"
#include "core/scans/scan_times.h"
#include "core/scans/scan_view.h"

namespace trajlo {

/// A scan that waits for the judgement of its time.
struct HeldScan {
  LidarScan scan;
  ScanTimes times;
  ScanView view;
  /// How many scans of all LiDARs had come before.
  std::int64_t arrival = 0;
  /// The newest scan of the LiDAR that came first, when this one came; as it was recorded.
  std::int64_t reference_ns = 0;
  /// By how many scans that came later.
  int overtaken = 0;
  /// It changed times with another one.
  bool is_exchanged = false;
};

enum class ScanFate { kHandedOn, kReordered, kRetimed, kAssumed, kMisfit, kRepeated, kApart };

struct Judgement {
  HeldScan* held;
  ScanFate fate;
  /// To be added to its times if it is handed on.
  std::int64_t shift_ns;
};

/// Judges the times of the scans of one LiDAR. (lidar_track_start.cc has the first scans,
/// lidar_track_steps.cc the steps of the clock, lidar_track_views.cc what views tell,
/// lidar_track_places.cc the places of scans that came before another one.)
///
/// Scans of a LiDAR come in order and at a steady period. One that goes on from the scan before is
/// handed on at once. Any other is held until those after it tell what happened:
///   - they fill the place before it: it came early, and is handed on in its turn; but if by its
///     view it does come next, only its stamp is wrong, and so is that of the other;
///   - they go on from it: there was a pause, or, if it lies behind the scan before, or so far
///     ahead that no pause explains it, or is next by its view, the clock made a step, which is
///     taken back from then on;
///   - they go on from the scan before it: its stamp is wrong. It gets the free place between its
///     neighbours if there is one for each such scan, and is dropped otherwise, as is a scan that
///     was handed on before.
/// So times that increase by steps below a minute are only changed where views tell of a step. If
/// the clock was set behind the first few scans, it is these that are moved. Nothing confirms the
/// stamp of a lone scan before the first pause or behind the last one: it is dropped.
class LidarTrack {
 public:
  /// A longer jump ahead is a step of the clock, if nothing else tells.
  static constexpr std::int64_t kLongestPause_ns = 60'000'000'000;

  /// What the other LiDARs tell.
  struct Others {
    /// The LiDAR that came first (null for itself), and how far another may be from it.
    const LidarTrack* reference = nullptr;
    std::int64_t max_lag_ns = 0;
    /// Those that have started.
    std::vector<const LidarTrack*> started;
  };
  /// A lasting step of the clock.
  struct Step {
    /// The first time behind it, as it was recorded.
    std::int64_t at_ns;
    /// Positive if the clock jumped ahead.
    std::int64_t length_ns;
    /// The times behind it are as they were recorded.
    bool is_true_behind;
  };

  const LidarClock& clock() const { return clock_; }
  /// Notes that a scan came, whatever will become of it.
  void NoteArrival(const LidarScan& scan, const ScanTimes& times, std::int64_t arrival);
  /// Of the scan that came last, as it was recorded.
  std::int64_t newest_ns() const { return newest_ns_; }

  /// True if nothing is held and a scan with these times goes on from the one before.
  bool GoesOn(const LidarScan& scan, const ScanTimes& times) const;
  /// Takes note of such a scan.
  void Note(const LidarScan& scan, const ScanTimes& times) {
    NoteAt(clock_.PlaceOf(scan, times), scan, times);
  }

  /// True if a scan that goes on has the points of one that came before: a driver that hangs sends
  /// the last one again and again, with new stamps.
  bool IsStuck(const LidarScan& scan, const ScanTimes& times) const;

  /// Takes a scan to be judged. It must stay where it is until then.
  void Hold(HeldScan* held);
  /// Judges what can be judged, in the order in which it is to be handed on; all if `is_final`.
  void Judge(const Others& others, bool is_final);

  /// What was found since it was taken last.
  std::vector<Judgement> TakeJudgements() { return std::exchange(judgements_, {}); }
  std::optional<Step> TakeStep() { return std::exchange(step_, std::nullopt); }
  /// Times that do not meet those of the first LiDAR.
  struct Apart {
    std::int64_t ahead_ns;
    /// The first LiDAR had fallen silent before this one spoke.
    bool never_together;
  };
  /// Motion-corrected scans that seem to have each other's points: by their views, in spite of
  /// stamps that go on; or by the order in which they came, where the views do not confirm their
  /// stamps.
  std::int64_t exchanged() const { return exchanged_; }
  /// Scans whose points have all one time, or those whose points do not: the fewer ones.
  std::int64_t odd_point_times() const { return std::min(with_one_time_, with_several_times_); }
  std::optional<Apart> TakeApart() { return std::exchange(apart_, std::nullopt); }
  /// Where the first scan that was handed on lies.
  std::int64_t first_ns() const { return first_ns_; }

 private:
  /// While this many are held, the oldest waits for more.
  static constexpr std::size_t kMostHeld = 8;

  void NoteAt(const ScanPlace& place, const LidarScan& scan, const ScanTimes& times);
  ScanPlace PlaceOf(const HeldScan& held) const { return clock_.PlaceOf(held.scan, held.times); }
  /// How far the scan lies behind the last that was handed on.
  std::int64_t Ahead(const HeldScan& held) const;
  double PeriodsAhead(const HeldScan& held) const;
  bool IsBehind(const HeldScan& held) const;
  bool IsPlausibleStep(const HeldScan& from, const HeldScan& to) const;
  /// How many scans, from this one on, go on from each other.
  std::size_t ChainLength(std::size_t first) const;
  bool DidTimePass(std::size_t i, const Others& others) const;
  bool IsBackOnTime(const HeldScan& held) const;
  bool IsSameClock(std::size_t i, const Others& others) const;
  bool IsNextByView(std::size_t i) const;
  std::size_t FirstByView(std::size_t next) const;
  std::optional<double> WayIfExchanged(const ScanView& next) const;
  bool MayBeExchanged(const ScanView& next) const;

  bool Start(const Others& others, bool is_final);
  std::vector<std::int64_t> EvenPace() const;
  bool FindOffset(const Others& others);
  bool SetBackForAStep(std::size_t first);
  std::size_t FirstOfChain() const;
  bool IsInPace(std::size_t i) const;
  bool HandOnNext();
  bool GoOnFromAnchor(const Others& others, bool is_final);
  std::size_t FindAnchor(const Others& others, bool is_final) const;
  std::size_t InStep(std::size_t i) const;
  std::size_t FindStep(const Others& others, bool is_final) const;
  void TakeBackStep(std::size_t anchor, const Others& others);
  void PlaceThoseBefore(const HeldScan& anchor);
  bool ComesFromBehind(std::size_t i) const;
  bool CameEarly(const HeldScan& held, const HeldScan& anchor) const;
  void SpreadEvenly(const std::vector<HeldScan*>& displaced, const ScanPlace& end);
  bool StandsStill() const;
  void GiveUpOldest(const Others& others);
  void HandOn(HeldScan* held, ScanFate fate, const ScanPlace& place);
  void Drop(HeldScan* held);
  void Remove(HeldScan* held, ScanFate fate, std::int64_t shift_ns);

  LidarClock clock_;
  std::vector<HeldScan*> held_;  ///< In the order in which they came.
  std::int64_t newest_ns_ = 0;
  std::int64_t newest_arrival_ = -1;
  std::int64_t first_ns_ = 0;
  std::int64_t last_recorded_begin_ns_ = 0;  ///< Of the last scan that was handed on.
  bool is_last_reordered_ = false;           ///< The last scan was overtaken by the one before it.
  bool stands_still_ = false;                ///< The last scan got its time because stamps do.
  ScanMemory memory_;
  std::deque<ScanView> views_;  ///< Of the last three scans that were handed on.
  std::int64_t exchanged_ = 0;
  std::int64_t with_one_time_ = 0;
  std::int64_t with_several_times_ = 0;
  std::vector<Judgement> judgements_;
  std::optional<Step> step_;
  std::optional<Apart> apart_;
};

}  // namespace trajlo
