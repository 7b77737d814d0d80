// SPDX-License-Identifier: MIT
#include "core/scans/scan_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trajlo {
namespace {

constexpr std::size_t kSamples = 4096;
/// Directions are 5 degrees apart.
constexpr std::size_t kAzimuths = 72;
constexpr std::size_t kElevations = 36;
constexpr std::size_t kFewestShared = 50;
constexpr float kLargestDifference = 0.5F;
/// What is nearer is the carrier, or no return.
constexpr float kNearest_m = 0.3F;

std::size_t DirectionOf(const Eigen::Vector3f& p, float range_m) {
  const float azimuth = std::atan2(p.y(), p.x()) / static_cast<float>(2.0 * M_PI) + 0.5F;
  const float sine = std::clamp(p.z() / range_m, -1.0F, 1.0F);
  const float elevation = std::asin(sine) / static_cast<float>(M_PI) + 0.5F;
  const auto part = [](float share, std::size_t parts) {
    return std::min(static_cast<std::size_t>(share * static_cast<float>(parts)), parts - 1);
  };
  return part(azimuth, kAzimuths) * kElevations + part(elevation, kElevations);
}

}  // namespace

ScanView::ScanView(const LidarScan& scan) {
  const std::size_t step = scan.points.size() / kSamples + 1;
  for (std::size_t i = 0; i < scan.points.size(); i += step) {
    const Eigen::Vector3f& p = scan.points[i].xyz_m;
    const float range_m = p.norm();
    if (std::isfinite(range_m) && range_m > kNearest_m) samples_m_.push_back(p);
  }
}

const std::vector<float>& ScanView::LogRanges() const {
  if (!log_ranges_.empty()) return log_ranges_;
  log_ranges_.assign(kAzimuths * kElevations, 0.0F);
  std::vector<float> counts(log_ranges_.size(), 0.0F);
  for (const Eigen::Vector3f& p : samples_m_) {
    const float range_m = p.norm();
    const std::size_t direction = DirectionOf(p, range_m);
    log_ranges_[direction] += std::log(range_m);
    counts[direction] += 1.0F;
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    log_ranges_[i] =
        counts[i] > 0.0F ? log_ranges_[i] / counts[i] : std::numeric_limits<float>::quiet_NaN();
  }
  samples_m_ = {};
  return log_ranges_;
}

std::optional<double> ScanView::Difference(const ScanView& a, const ScanView& b) {
  const std::vector<float>& ranges_a = a.LogRanges();
  const std::vector<float>& ranges_b = b.LogRanges();
  double sum = 0.0;
  std::size_t shared = 0;
  for (std::size_t i = 0; i < ranges_a.size(); ++i) {
    const float difference = std::abs(ranges_a[i] - ranges_b[i]);
    if (std::isnan(difference)) continue;
    sum += static_cast<double>(std::min(difference, kLargestDifference));
    ++shared;
  }
  if (shared < kFewestShared) return std::nullopt;
  return sum / static_cast<double>(shared);
}

}  // namespace trajlo
