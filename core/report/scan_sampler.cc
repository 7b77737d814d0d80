// SPDX-License-Identifier: MIT
#include "core/report/scan_sampler.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/sensing/turn_up.h"

namespace trajlo {
namespace {

/// Even over (0, 1], also along every regular choice of indices, such as the points of one ring.
double EvenShare(std::size_t index) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  const double x = static_cast<double>(index + 1) * kGoldenRatio;
  return 1.0 - (x - std::floor(x));
}

std::int64_t FloorDivide(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

}  // namespace

std::optional<Eigen::Vector3f> ScanSampler::InBody(const LidarPoint& point,
                                                   const SE3& T_body_lidar) const {
  const double range_m = point.xyz_m.cast<double>().norm();
  const bool usable = range_m >= sensing_.min_range_m && range_m <= sensing_.max_range_m;
  if (!usable) return std::nullopt;  // NaN, too
  const auto turn_rad = static_cast<float>(sensing_.vertical_correction_deg * M_PI / 180.0);
  return (T_body_lidar * TurnUp(point.xyz_m, turn_rad).cast<double>()).cast<float>();
}

void ScanSampler::Note(const LidarScan& scan) {
  const auto lidar = static_cast<std::size_t>(scan.lidar_id);
  const SE3 T_body_lidar =
      lidar < sensing_.T_body_lidar.size() ? sensing_.T_body_lidar[lidar] : SE3();
  std::optional<std::int64_t> last_index;
  Moment* moment = nullptr;  // the one of last_index, if it is kept
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const LidarPoint& point = scan.points[i];
    if (!origin_ns_) origin_ns_ = point.t_ns;
    const std::int64_t index = FloorDivide(point.t_ns - *origin_ns_, options_.moment_ns);
    if (index != last_index) moment = index % stride_ == 0 ? &moments_[index] : nullptr;
    last_index = index;
    if (moment == nullptr) continue;
    if (const auto p_body = InBody(point, T_body_lidar)) {
      // Weighted sampling without replacement: the smallest of exponential variates whose rates
      // are the weights (Efraimidis and Spirakis, 2006).
      const auto key = static_cast<float>(-std::log(EvenShare(i)) / point.xyz_m.norm());
      moment->push_back({*p_body, point.intensity, point.t_ns, key});
    }
  }
  for (auto& [index, kept] : moments_) Thin(&kept);
  while (moments_.size() > options_.max_moments) DropEveryOther();
}

void ScanSampler::Thin(Moment* moment) const {
  if (moment->size() <= options_.points_per_moment) return;
  const auto end = moment->begin() + static_cast<std::ptrdiff_t>(options_.points_per_moment);
  const auto by_key = [](const Kept& a, const Kept& b) {
    return a.key != b.key ? a.key < b.key : a.t_ns < b.t_ns;
  };
  std::nth_element(moment->begin(), end, moment->end(), by_key);
  moment->erase(end, moment->end());
  moment->shrink_to_fit();
}

void ScanSampler::DropEveryOther() {
  stride_ *= 2;
  for (auto it = moments_.begin(); it != moments_.end();) {
    it = it->first % stride_ == 0 ? std::next(it) : moments_.erase(it);
  }
}

std::vector<WorldPoint> ScanSampler::Deskew(const Trajectory& trajectory) const {
  std::vector<WorldPoint> points;
  for (const auto& [index, moment] : moments_) {
    const std::int64_t moment_ns = *origin_ns_ + index * options_.moment_ns;
    for (const Kept& kept : moment) {
      const std::optional<SE3> T_world_body = trajectory.At(kept.t_ns);
      if (!T_world_body) continue;
      const Eigen::Vector3d p_world = *T_world_body * kept.p_body_m.cast<double>();
      points.push_back({p_world.cast<float>(), kept.intensity, moment_ns});
    }
  }
  return points;
}

}  // namespace trajlo
