// SPDX-License-Identifier: MIT
// The scans that came before one that others go on from: where they belong, if anywhere.
#include <algorithm>
#include <cmath>

#include "core/scans/lidar_track.h"

namespace trajlo {

/// Of the scans that came before the anchor, some lie before it in time, too, some came early, and
/// the others have wrong stamps.
void LidarTrack::PlaceThoseBefore(const HeldScan& anchor) {
  const ScanPlace last = clock_.last();
  const ScanPlace end = PlaceOf(anchor);
  std::vector<HeldScan*> in_place, displaced, known;
  for (HeldScan* held : held_) {
    if (held == &anchor) break;
    const std::int64_t begin_ns = PlaceOf(*held).begin_ns;
    if (begin_ns > last.begin_ns && begin_ns < end.begin_ns) {
      in_place.push_back(held);
    } else if (memory_.HasPoints(held->scan)) {
      known.push_back(held);
    } else if (!CameEarly(*held, anchor)) {
      displaced.push_back(held);
    }
  }
  for (HeldScan* held : known) Drop(held);
  const double periods = static_cast<double>(Difference(end.begin_ns, last.begin_ns)) /
                         static_cast<double>(std::max<std::int64_t>(clock_.period_ns(), 1));
  const auto wrong = static_cast<double>(displaced.size());
  if (in_place.empty() && std::abs(periods - 1.0 - wrong) < 0.5) {
    SpreadEvenly(displaced, end);
    return;
  }
  for (HeldScan* held : displaced) Drop(held);
  std::sort(in_place.begin(), in_place.end(), [](const HeldScan* a, const HeldScan* b) {
    return a->times.begin_ns < b->times.begin_ns;
  });
  for (HeldScan* held : in_place) {
    const bool is_held = std::find(held_.begin(), held_.end(), held) != held_.end();
    if (!is_held) continue;
    if (Ahead(*held) > 0) {
      HandOn(held, ScanFate::kHandedOn, PlaceOf(*held));
    } else {
      Drop(held);  // Its time is that of another.
    }
  }
}

/// True if there is a place for the scan among those from the anchor on.
bool LidarTrack::CameEarly(const HeldScan& held, const HeldScan& anchor) const {
  const std::int64_t begin_ns = PlaceOf(held).begin_ns;
  if (begin_ns <= PlaceOf(anchor).begin_ns) return false;
  bool is_within = false;
  for (const HeldScan* other : held_) {
    if (other == &held) continue;
    const std::int64_t other_ns = PlaceOf(*other).begin_ns;
    if (Distance(begin_ns, other_ns) <= clock_.period_ns() / 2) return false;
    is_within = is_within || (other->arrival > anchor.arrival && other_ns > begin_ns);
  }
  return is_within;
}

/// Gives the scans even times between the last one and `end`.
void LidarTrack::SpreadEvenly(const std::vector<HeldScan*>& displaced, const ScanPlace& end) {
  const ScanPlace begin = clock_.last();
  const auto steps = static_cast<std::int64_t>(displaced.size()) + 1;
  const std::int64_t stamp_step_ns = Difference(end.stamp_ns, begin.stamp_ns) / steps;
  const std::int64_t step_ns = Difference(end.begin_ns, begin.begin_ns) / steps;
  for (std::int64_t k = 1; k < steps; ++k) {
    HeldScan* held = displaced[static_cast<std::size_t>(k - 1)];
    ScanPlace place{begin.begin_ns + k * step_ns, 0};
    const std::int64_t by_stamp_ns = Sum(begin.stamp_ns + k * stamp_step_ns,
                                         Difference(held->times.begin_ns, held->scan.stamp_ns));
    if (Distance(by_stamp_ns, place.begin_ns) < step_ns / 2) place.begin_ns = by_stamp_ns;
    place.stamp_ns = begin.stamp_ns + k * stamp_step_ns;
    HandOn(held, ScanFate::kRetimed, place);
  }
}

}  // namespace trajlo
