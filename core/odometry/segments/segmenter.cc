// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segmenter.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "core/odometry/segments/turn_up.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr std::int64_t kUnseen = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();

/// No segment is shorter: velocities are differences of poses over its duration.
constexpr std::int64_t kShortest_ns = 1'000'000;

constexpr std::int64_t kLookEvery_ns = 2'000'000'000;

std::int64_t DurationNs(double seconds) { return std::max(Nanoseconds(seconds), kShortest_ns); }

std::int64_t FirstTime_ns(const LidarScan& scan) {
  std::int64_t first_ns = kForever;
  for (const LidarPoint& point : scan.points) first_ns = std::min(first_ns, point.t_ns);
  return first_ns;
}

}  // namespace

Segmenter::Segmenter(const SegmenterOptions& options)
    : options_(options),
      interval_ns_(DurationNs(options.interval_s)),
      max_gap_ns_(DurationNs(options.max_gap_s)),
      max_lag_ns_(Nanoseconds(options.max_lag_s)),
      thinner_(options.map_voxel_m, options.registration_voxel_m,
               static_cast<std::size_t>(options.max_registration_points)),
      complete_until_ns_(kUnseen),
      newest_ns_(std::max<std::size_t>(options.T_body_lidar.size(), 1), kUnseen),
      discrete_step_ns_(interval_ns_),
      next_look_ns_(kUnseen) {}

void Segmenter::AddScan(const LidarScan& scan) {
  counts_.received += static_cast<std::int64_t>(scan.points.size());
  Look(scan);
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  if (lidar >= newest_ns_.size()) newest_ns_.resize(lidar + 1, kUnseen);
  has_point_times_ = has_point_times_ || scan.has_point_times;
  if (has_point_times_) {
    AddContinuous(scan);
  } else {
    AddDiscrete(scan);
  }
  CompletePassed();
}

/// The first scan is left out: there, the frame of a registered cloud is the LiDAR's.
void Segmenter::Look(const LidarScan& scan) {
  if (scan.stamp_ns < next_look_ns_) return;
  if (next_look_ns_ != kUnseen) counts_.sight_lines.Add(scan);
  next_look_ns_ = scan.stamp_ns + kLookEvery_ns;
}

SE3 Segmenter::PoseOf(std::size_t lidar) const {
  return lidar < options_.T_body_lidar.size() ? options_.T_body_lidar[lidar] : SE3();
}

double Segmenter::ClockOf_s(std::size_t lidar) const {
  return lidar < clocks_s_.size() ? clocks_s_[lidar] : 0.0;
}

bool Segmenter::Accept(const LidarPoint& point, const SE3& T_body_lidar, Eigen::Vector3f* p_body) {
  if (!point.xyz_m.allFinite()) {
    ++counts_.not_finite;
    return false;
  }
  const double squared_range_m2 = point.xyz_m.cast<double>().squaredNorm();
  if (squared_range_m2 < options_.min_range_m * options_.min_range_m) {
    ++counts_.too_near;
    return false;
  }
  if (squared_range_m2 > options_.max_range_m * options_.max_range_m) {
    ++counts_.too_far;
    return false;
  }
  const auto up_rad = static_cast<float>(options_.vertical_correction_deg * M_PI / 180.0);
  *p_body = (T_body_lidar * TurnUp(point.xyz_m, up_rad).cast<double>()).cast<float>();
  return true;
}

void Segmenter::OpenNext(std::int64_t end_ns, bool is_gap) {
  slots_.push_back({*end_ns_, end_ns, is_gap, {}, {}});
  if (!is_gap) slots_.back().points.reserve(usual_points_);
  end_ns_ = end_ns;
}

Segmenter::Slot& Segmenter::SlotAt(std::int64_t t_ns) {
  while (t_ns >= *end_ns_) OpenNext(*end_ns_ + interval_ns_);
  std::size_t i = slots_.size() - 1;
  while (t_ns < slots_[i].begin_ns) --i;
  return slots_[i];
}

std::int64_t Segmenter::FirstOpen_ns() const {
  for (const Slot& slot : slots_) {
    if (slot.end_ns > complete_until_ns_) return slot.begin_ns;
  }
  return *end_ns_;
}

/// Opens the first slot, or a gap where a scan that begins at `first_ns` comes after a long pause.
void Segmenter::ReachTo(std::int64_t first_ns) {
  if (!end_ns_) {
    end_ns_ = first_ns;
    OpenNext(first_ns + interval_ns_);
  }
  if (first_ns > *end_ns_ + max_gap_ns_) {
    OpenNext(first_ns, true);
    CompleteUntil(first_ns);
  }
}

void Segmenter::AddContinuous(const LidarScan& scan) {
  if (scan.points.empty()) return;
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar = PoseOf(lidar);
  const std::int64_t clock_ns = Nanoseconds(ClockOf_s(lidar));
  const std::int64_t first_ns = FirstTime_ns(scan) + clock_ns;
  ReachTo(first_ns);

  const std::int64_t first_open_ns = FirstOpen_ns();
  std::int64_t newest_ns = kUnseen;
  Slot* slot = nullptr;
  for (const LidarPoint& point : scan.points) {
    const std::int64_t t_ns = point.t_ns + clock_ns;
    if (t_ns < first_open_ns) {
      ++counts_.too_late;
      continue;
    }
    if (t_ns > std::max(*end_ns_, first_ns) + max_gap_ns_) {
      ++counts_.wrong_time;
      continue;
    }
    newest_ns = std::max(newest_ns, t_ns);
    Eigen::Vector3f p_body;
    if (!Accept(point, T_body_lidar, &p_body)) continue;
    // Mostly the slot of the point before.
    if (slot == nullptr || !slot->Holds(t_ns)) {
      slot = &SlotAt(t_ns);
      slot->is_instant = false;
    }
    const double alpha = static_cast<double>(t_ns - slot->begin_ns) /
                         static_cast<double>(slot->end_ns - slot->begin_ns);
    slot->points.push_back({p_body, static_cast<float>(alpha), static_cast<std::uint16_t>(lidar)});
  }
  newest_ns_[lidar] = std::max(newest_ns_[lidar], newest_ns);
  for (Slot& reached : slots_) {
    if (reached.end_ns <= first_ns) continue;
    reached.clocks_s.resize(newest_ns_.size());
    reached.clocks_s[lidar] = ClockOf_s(lidar);
  }
}

/// The slot that the points of a scan without times belong to; null if it is too late for them.
Segmenter::Slot* Segmenter::DiscreteSlotAt(std::int64_t stamp_ns) {
  if (!end_ns_) {
    end_ns_ = stamp_ns;
    OpenNext(stamp_ns);
  } else if (stamp_ns >= *end_ns_ + kShortest_ns) {
    const std::int64_t step_ns = stamp_ns - *end_ns_;
    if (step_ns > std::max(max_gap_ns_, 2 * kShortest_ns)) {
      OpenNext(stamp_ns - std::min(discrete_step_ns_, step_ns / 2), true);
    } else {
      discrete_step_ns_ = step_ns;
    }
    OpenNext(stamp_ns);
  }
  for (std::size_t i = slots_.size(); i-- > 0;) {
    Slot& slot = slots_[i];
    if (slot.end_ns <= complete_until_ns_ || slot.is_gap) return nullptr;
    if (std::abs(stamp_ns - slot.end_ns) < kShortest_ns) return &slot;
    if (stamp_ns < slot.begin_ns + kShortest_ns) continue;
    // From another LiDAR, between two earlier scans.
    const auto before = slots_.insert(slots_.begin() + static_cast<std::ptrdiff_t>(i),
                                      {slot.begin_ns, stamp_ns, false, {}, {}});
    slots_[i + 1].begin_ns = stamp_ns;
    return &*before;
  }
  return nullptr;
}

void Segmenter::AddDiscrete(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar = PoseOf(lidar);
  Slot* slot = DiscreteSlotAt(scan.stamp_ns);
  if (slot == nullptr) {
    counts_.too_late += static_cast<std::int64_t>(scan.points.size());
    return;
  }
  for (const LidarPoint& point : scan.points) {
    Eigen::Vector3f p_body;
    if (!Accept(point, T_body_lidar, &p_body)) continue;
    slot->points.push_back({p_body, 1.0F, static_cast<std::uint16_t>(lidar)});
  }
  slot->is_instant = !slot->points.empty();
  newest_ns_[lidar] = std::max(newest_ns_[lidar], slot->end_ns);
}

/// Completes what all LiDARs have passed, but waits only for a while for one that has not been
/// heard yet, and not at all for one that fell silent.
void Segmenter::CompletePassed() {
  const std::int64_t leader = *std::max_element(newest_ns_.begin(), newest_ns_.end());
  if (leader == kUnseen) return;
  std::int64_t slowest = leader;
  bool all_seen = true;
  for (const std::int64_t newest : newest_ns_) {
    all_seen = all_seen && newest != kUnseen;
    if (newest == kUnseen || newest < leader - max_lag_ns_) continue;
    slowest = std::min(slowest, newest);
  }
  if (!all_seen) slowest = std::min(slowest, leader - max_lag_ns_);
  CompleteUntil(slowest);
}

void Segmenter::CompleteUntil(std::int64_t t_ns) {
  complete_until_ns_ = std::max(complete_until_ns_, t_ns);
}

void Segmenter::Finish() { CompleteUntil(kForever); }

std::optional<SegmentCloud> Segmenter::Next() {
  if (slots_.empty() || slots_.front().end_ns > complete_until_ns_) return std::nullopt;
  Slot slot = std::move(slots_.front());
  slots_.pop_front();
  SegmentCloud cloud;
  cloud.begin_ns = slot.begin_ns;
  cloud.end_ns = slot.end_ns;
  cloud.is_gap = slot.is_gap;
  cloud.is_instant = slot.is_instant;
  usual_points_ = slot.points.size() + slot.points.size() / 8;
  slot.clocks_s.resize(newest_ns_.size());
  for (std::size_t lidar = 0; lidar < newest_ns_.size(); ++lidar) {
    cloud.lidar_origins_body_m.push_back(PoseOf(lidar).t);
    cloud.corrections.push_back({SE3(), slot.clocks_s[lidar]});
  }
  thinner_.Thin(slot.points, &cloud);
  return cloud;
}

}  // namespace trajlo
