// SPDX-License-Identifier: MIT
#include "core/report/scan_sampler.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/segments/turn_up.h"
#include "core/odometry/trajectory/trajectory_cursor.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Even over (0, 1], also along every regular choice of indices, such as the points of one ring.
double EvenShare(std::size_t index) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double x = static_cast<double>(index + 1) * kGoldenRatio;
  return 1.0 - (x - std::floor(x));
}

/// The key of a point that is never taken: it compares as smaller than none.
constexpr float kUnusable = std::numeric_limits<float>::quiet_NaN();

std::int64_t FloorDivide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

void ScanSampler::Note(const LidarScan& scan) {
  const std::vector<LidarPoint>& points = scan.points;
  SetKeys(points);
  std::size_t first = 0;
  while (first < points.size()) {
    if (!origin_ns_) origin_ns_ = points[first].t_ns;
    const std::int64_t index = FloorDivide(points[first].t_ns - *origin_ns_, options_.moment_ns);
    const std::int64_t begin_ns = *origin_ns_ + index * options_.moment_ns;
    std::size_t end = first + 1;
    while (end < points.size() && points[end].t_ns >= begin_ns &&
           points[end].t_ns < begin_ns + options_.moment_ns) {
      ++end;
    }
    if (index % stride_ == 0) Take(scan, first, end, &moments_[index]);
    first = end;
  }
  while (moments_.size() > options_.max_moments) DropEveryOther();
}

/// Weighted sampling without replacement: those with the smallest of exponential variates whose
/// rates are the weights (Efraimidis and Spirakis, 2006).
void ScanSampler::SetKeys(const std::vector<LidarPoint>& points) {
  for (std::size_t i = variates_.size(); i < points.size(); ++i) {
    variates_.push_back(static_cast<float>(-std::log(EvenShare(i))));
  }
  const double min_squared = segmenter_.min_range_m * segmenter_.min_range_m;
  const double max_squared = segmenter_.max_range_m * segmenter_.max_range_m;
  keys_.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = points[i].xyz_m.cast<double>().squaredNorm();
    const bool is_usable = squared >= min_squared && squared <= max_squared;  // no NaN
    keys_[i] = is_usable ? variates_[i] / std::sqrt(static_cast<float>(squared)) : kUnusable;
  }
}

/// Points [first, end) of a scan, which lie in one moment.
void ScanSampler::Take(const LidarScan& scan, std::size_t first, std::size_t end, Moment* moment) {
  const auto is_wanted = [&](float key) { return key <= moment->largest_key; };
  const auto keys = keys_.begin();
  // Points in no order of time come one by one: most of them must cost no more than this look.
  if (std::none_of(keys + static_cast<std::ptrdiff_t>(first),
                   keys + static_cast<std::ptrdiff_t>(end), is_wanted)) {
    return;
  }
  const std::size_t count = options_.points_per_moment;
  std::vector<Kept>& points = moment->points;
  smallest_.clear();
  for (const Kept& kept : points) smallest_.push_back(kept.key);
  float& bound = moment->largest_key;
  const auto drop_larger = [&] {
    if (smallest_.size() <= count) return;
    const auto last = smallest_.begin() + static_cast<std::ptrdiff_t>(count) - 1;
    std::nth_element(smallest_.begin(), last, smallest_.end());
    bound = *last;
    smallest_.resize(count);
  };
  for (std::size_t i = first; i < end; ++i) {
    if (!is_wanted(keys_[i])) continue;
    smallest_.push_back(keys_[i]);
    if (smallest_.size() > 2 * count) drop_larger();
  }
  drop_larger();
  points.erase(std::remove_if(points.begin(), points.end(),
                              [&](const Kept& kept) { return kept.key > bound; }),
               points.end());
  points.reserve(smallest_.size());
  const auto lidar = static_cast<std::uint16_t>(scan.lidar_id);
  for (std::size_t i = first; i < end && points.size() < count; ++i) {
    if (!is_wanted(keys_[i])) continue;
    const LidarPoint& point = scan.points[i];
    points.push_back({point.xyz_m, point.intensity, point.t_ns, keys_[i], lidar});
  }
}

void ScanSampler::DropEveryOther() {
  stride_ *= 2;
  for (auto it = moments_.begin(); it != moments_.end();) {
    it = it->first % stride_ == 0 ? std::next(it) : moments_.erase(it);
  }
}

std::vector<WorldPoint> ScanSampler::Deskew(const Trajectory& trajectory,
                                            const std::vector<LidarPlace>& rig) const {
  const auto turn_rad = static_cast<float>(segmenter_.vertical_correction_deg * M_PI / 180.0);
  TrajectoryCursor cursor(&trajectory, Nanoseconds(segmenter_.max_gap_s));
  std::vector<WorldPoint> points;
  std::size_t kept_points = 0;
  for (const auto& [index, moment] : moments_) kept_points += moment.points.size();
  points.reserve(kept_points);
  for (const auto& [index, moment] : moments_) {
    const std::int64_t moment_ns = *origin_ns_ + index * options_.moment_ns;
    for (const Kept& kept : moment.points) {
      const LidarPlace lidar = kept.lidar < rig.size() ? rig[kept.lidar] : LidarPlace();
      const std::int64_t t_ns = kept.t_ns + Nanoseconds(lidar.clock_moved_s);
      if (cursor.MoveTo(t_ns) != TrajectoryCursor::Time::kCovered) continue;
      const Eigen::Vector3d p_lidar = TurnUp(kept.p_lidar_m, turn_rad).cast<double>();
      const Eigen::Vector3d p_body = lidar.T_body_lidar * p_lidar;
      points.push_back({cursor.ToWorld(p_body).cast<float>(), kept.intensity, moment_ns});
    }
  }
  return points;
}

}  // namespace trajlo
