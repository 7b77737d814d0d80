// SPDX-License-Identifier: MIT
// What the views of scans tell about their order, and about steps of the clock.
#include <algorithm>

#include "core/scans/lidar_track.h"

namespace trajlo {
namespace {

/// Of the differences from the scan before, in a steady motion: that of the next scan is smaller
/// than this share of that of the second next, ...
constexpr double kClearlyNearer = 0.85;
/// ... and differences of neighbours are the same within this factor.
constexpr double kAlike = 1.25;
/// Of fewer periods, a step of the clock is not told from lost scans.
constexpr double kFewestPeriods = 2.5;
/// A scan whose stamp is farther ahead did not exchange it with the next one.
constexpr double kMostPeriodsEarly = 3.5;

}  // namespace

double LidarTrack::PeriodsAhead(const HeldScan& held) const {
  return static_cast<double>(Ahead(held)) /
         static_cast<double>(std::max<std::int64_t>(clock_.period_ns(), 1));
}

/// Which of the held scans comes next: that one (`next`) whose stamp says so, unless one that came
/// before it is clearly more like the last one.
std::size_t LidarTrack::FirstByView(std::size_t next) const {
  const auto difference = ScanView::Difference(views_.back(), held_[next]->view);
  if (!difference) return next;
  std::size_t first = next;
  double least = kClearlyNearer * *difference;
  for (std::size_t i = 0; i < next; ++i) {
    if (Ahead(*held_[i]) <= 0 || PeriodsAhead(*held_[i]) > kMostPeriodsEarly) continue;
    const auto other = ScanView::Difference(views_.back(), held_[i]->view);
    if (!other || *other >= least) continue;
    first = i;
    least = *other;
  }
  return first;
}

/// True if the views say that no time passed between the last scan and this one: in a steady motion
/// before and behind, they differ as neighbours do.
bool LidarTrack::IsNextByView(std::size_t i) const {
  if (i + 2 >= held_.size() || views_.size() < 2) return false;
  const ScanView& last_but_one = views_[views_.size() - 2];
  // A clock that is back where it was is next without its offset.
  const bool is_back = clock_.IsNext(held_[i]->times.begin_ns);
  if (!is_back && PeriodsAhead(*held_[i]) < kFewestPeriods) return false;
  const ScanView& here = held_[i]->view;
  const auto before = ScanView::Difference(last_but_one, views_.back());
  const auto across = ScanView::Difference(views_.back(), here);
  const auto two_across = ScanView::Difference(last_but_one, here);
  const auto behind = ScanView::Difference(here, held_[i + 1]->view);
  const auto two_behind = ScanView::Difference(here, held_[i + 2]->view);
  if (!before || !across || !two_across || !behind || !two_behind) return false;
  const bool is_moving = *two_across > kAlike * *across && *two_behind > kAlike * *behind;
  const double neighbors = std::min(*before, *behind);
  return is_moving && *across < kAlike * neighbors && *two_across < kAlike * *two_behind;
}

/// How long the way by the views is from the last but two to `next` with the two scans between them
/// exchanged, in relation to the way as it is.
std::optional<double> LidarTrack::WayIfExchanged(const ScanView& next) const {
  if (views_.size() < 3) return std::nullopt;
  const auto begin = ScanView::Difference(views_[0], views_[1]);
  const auto end = ScanView::Difference(views_[2], next);
  const auto begin_exchanged = ScanView::Difference(views_[0], views_[2]);
  const auto end_exchanged = ScanView::Difference(views_[1], next);
  if (!begin || !end || !begin_exchanged || !end_exchanged) return std::nullopt;
  const double way = *begin + *end;
  if (way == 0.0) return std::nullopt;
  return (*begin_exchanged + *end_exchanged) / way;
}

/// True if the last two scans seem to have each other's points: clearly, or if their stamps
/// contradict the order in which they came, and the views do not clearly confirm the stamps.
bool LidarTrack::MayBeExchanged(const ScanView& next) const {
  const auto way = WayIfExchanged(next);
  if (is_last_reordered_) return !way || *way < 1.0 / kClearlyNearer;
  return way && *way < kClearlyNearer;
}

}  // namespace trajlo
