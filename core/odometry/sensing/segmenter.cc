// SPDX-License-Identifier: MIT
#include "core/odometry/sensing/segmenter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/odometry/sensing/turn_up.h"

namespace trajlo {
namespace {

constexpr std::int64_t kUnseen = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kForever = std::numeric_limits<std::int64_t>::max();

std::int64_t ToNs(double seconds) { return std::llround(seconds * 1e9); }

/// Keeps `count` points at even distances in the order of the list.
void ThinEvenly(std::size_t count, std::vector<SegmentPoint>* points) {
  if (count == 0 || points->size() <= count) return;
  for (std::size_t i = 0; i < count; ++i) (*points)[i] = (*points)[i * points->size() / count];
  points->resize(count);
}

}  // namespace

Segmenter::Segmenter(const SegmenterOptions& options, int divisions)
    : options_(options),
      slot_ns_(ToNs(options.interval_s / divisions)),
      map_filter_(options.map_voxel_m),
      registration_filter_(options.registration_voxel_m),
      complete_until_ns_(kUnseen),
      newest_ns_(std::max<std::size_t>(options.T_body_lidar.size(), 1), kUnseen) {}

void Segmenter::AddScan(const LidarScan& scan) {
  counts_.received += static_cast<std::int64_t>(scan.points.size());
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  if (lidar >= newest_ns_.size()) newest_ns_.resize(lidar + 1, kUnseen);
  if (scan.has_point_times) {
    AddContinuous(scan);
  } else {
    AddDiscrete(scan);
  }
}

SE3 Segmenter::PoseOf(std::size_t lidar) const {
  return lidar < options_.T_body_lidar.size() ? options_.T_body_lidar[lidar] : SE3();
}

bool Segmenter::Accept(const LidarPoint& point, const SE3& T_body_lidar, Eigen::Vector3f* p_body) {
  Eigen::Vector3f p = point.xyz_m;
  if (!p.allFinite()) {
    ++counts_.not_finite;
    return false;
  }
  const double range = p.cast<double>().norm();
  if (range < options_.min_range_m) {
    ++counts_.too_near;
    return false;
  }
  if (range > options_.max_range_m) {
    ++counts_.too_far;
    return false;
  }
  if (options_.vertical_correction_deg != 0.0) {
    p = TurnUp(p, static_cast<float>(options_.vertical_correction_deg * M_PI / 180.0));
  }
  *p_body = (T_body_lidar * p.cast<double>()).cast<float>();
  return true;
}

void Segmenter::OpenNext(std::int64_t end_ns, bool is_whole, bool is_gap) {
  slots_.push_back({*end_ns_, end_ns, is_whole, is_gap, {}});
  end_ns_ = end_ns;
}

Segmenter::Slot& Segmenter::SlotAt(std::int64_t t_ns) {
  while (t_ns >= *end_ns_) OpenNext(*end_ns_ + slot_ns_, false);
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

void Segmenter::AddContinuous(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar = PoseOf(lidar);
  if (scan.points.empty()) return;
  std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
  for (const LidarPoint& point : scan.points) first_ns = std::min(first_ns, point.t_ns);

  if (!end_ns_) {
    end_ns_ = first_ns;
    OpenNext(first_ns + ToNs(options_.first_interval_s), true);
  }
  const std::int64_t max_gap_ns = ToNs(options_.max_gap_s);
  if (first_ns > *end_ns_ + max_gap_ns) {
    OpenNext(first_ns, true, true);
    CompleteUntil(first_ns);
  }

  const std::int64_t first_open_ns = FirstOpen_ns();
  std::int64_t newest_ns = kUnseen;
  for (const LidarPoint& point : scan.points) {
    if (point.t_ns < first_open_ns || point.t_ns > *end_ns_ + max_gap_ns) {
      ++counts_.too_late;
      continue;
    }
    newest_ns = std::max(newest_ns, point.t_ns);
    Eigen::Vector3f p_body;
    if (!Accept(point, T_body_lidar, &p_body)) continue;
    Slot& slot = SlotAt(point.t_ns);
    const double alpha = static_cast<double>(point.t_ns - slot.begin_ns) /
                         static_cast<double>(slot.end_ns - slot.begin_ns);
    slot.points.push_back({p_body, static_cast<float>(alpha), static_cast<std::uint16_t>(lidar)});
  }
  newest_ns_[lidar] = std::max(newest_ns_[lidar], newest_ns);

  const std::int64_t leader = *std::max_element(newest_ns_.begin(), newest_ns_.end());
  std::int64_t slowest = leader;
  for (const std::int64_t newest : newest_ns_) {
    if (newest == kUnseen || newest < leader - ToNs(options_.max_lag_s)) continue;
    slowest = std::min(slowest, newest);
  }
  const bool all_seen =
      std::find(newest_ns_.begin(), newest_ns_.end(), kUnseen) == newest_ns_.end();
  // A LiDAR that has not spoken yet is waited for only so long.
  if (!all_seen) slowest = std::min(slowest, leader - ToNs(options_.max_lag_s));
  CompleteUntil(slowest);
}

void Segmenter::AddDiscrete(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar = PoseOf(lidar);
  if (end_ns_ && scan.stamp_ns <= *end_ns_) {
    counts_.too_late += static_cast<std::int64_t>(scan.points.size());
    return;
  }
  if (!end_ns_) end_ns_ = scan.stamp_ns;
  if (scan.stamp_ns > *end_ns_ + ToNs(options_.max_gap_s)) {
    OpenNext(scan.stamp_ns - 1, true, true);
  }
  OpenNext(scan.stamp_ns, true);
  for (const LidarPoint& point : scan.points) {
    Eigen::Vector3f p_body;
    if (!Accept(point, T_body_lidar, &p_body)) continue;
    slots_.back().points.push_back({p_body, 1.0F, static_cast<std::uint16_t>(lidar)});
  }
  newest_ns_[lidar] = scan.stamp_ns;
  CompleteUntil(scan.stamp_ns);
}

void Segmenter::CompleteUntil(std::int64_t t_ns) {
  complete_until_ns_ = std::max(complete_until_ns_, t_ns);
}

void Segmenter::Finish() { CompleteUntil(kForever); }

std::optional<SegmentCloud> Segmenter::Next(int slots) {
  std::size_t wanted = static_cast<std::size_t>(slots);
  for (std::size_t i = 0; i < std::min(wanted, slots_.size()); ++i) {
    if (slots_[i].is_whole) wanted = std::max<std::size_t>(i, 1);
  }
  if (complete_until_ns_ == kForever) wanted = std::min(wanted, slots_.size());
  if (wanted == 0 || slots_.size() < wanted || slots_[wanted - 1].end_ns > complete_until_ns_) {
    return std::nullopt;
  }
  SegmentCloud cloud;
  cloud.begin_ns = slots_.front().begin_ns;
  cloud.end_ns = slots_[wanted - 1].end_ns;
  cloud.is_gap = slots_.front().is_gap;
  for (std::size_t lidar = 0; lidar < newest_ns_.size(); ++lidar) {
    cloud.lidar_origins_body_m.push_back(PoseOf(lidar).t);
  }
  Thin(TakePoints(wanted), &cloud);
  return cloud;
}

/// The points of the first `slots` slots, which are removed, with alpha over all of them.
std::vector<SegmentPoint> Segmenter::TakePoints(std::size_t slots) {
  std::vector<SegmentPoint> points = std::move(slots_.front().points);
  if (slots > 1) {
    const double slots_inverse = 1.0 / static_cast<double>(slots);
    for (SegmentPoint& point : points) point.alpha *= static_cast<float>(slots_inverse);
    for (std::size_t i = 1; i < slots; ++i) {
      for (SegmentPoint point : slots_[i].points) {
        point.alpha = static_cast<float>(
            (static_cast<double>(i) + static_cast<double>(point.alpha)) * slots_inverse);
        points.push_back(point);
      }
    }
  }
  slots_.erase(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(slots));
  return points;
}

void Segmenter::Thin(std::vector<SegmentPoint> points, SegmentCloud* cloud) {
  if (first_taken_) {
    map_filter_.Filter(points, &cloud->map_points);
    registration_filter_.Filter(cloud->map_points, &cloud->registration_points);
    ThinEvenly(static_cast<std::size_t>(options_.max_registration_points),
               &cloud->registration_points);
    return;
  }
  // The start of motion is found by comparing the two halves of the first segment: each must keep
  // its own points where the other has some, too.
  first_taken_ = true;
  const auto middle = std::stable_partition(
      points.begin(), points.end(), [](const SegmentPoint& point) { return point.alpha < 0.5F; });
  std::vector<SegmentPoint> kept;
  for (const auto& half : {std::vector<SegmentPoint>(points.begin(), middle),
                           std::vector<SegmentPoint>(middle, points.end())}) {
    map_filter_.Filter(half, &kept);
    cloud->map_points.insert(cloud->map_points.end(), kept.begin(), kept.end());
    const std::vector<SegmentPoint> fine = kept;
    registration_filter_.Filter(fine, &kept);
    cloud->registration_points.insert(cloud->registration_points.end(), kept.begin(), kept.end());
  }
}

}  // namespace trajlo
