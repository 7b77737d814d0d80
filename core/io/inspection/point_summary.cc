// SPDX-License-Identifier: MIT
#include "core/io/inspection/point_summary.h"

#include <algorithm>
#include <cmath>

#include "core/scans/median.h"

namespace trajlo {
namespace {

/// Up to here bins are narrow.
constexpr double kNearEnd_m = 1000.0;

const Column* FindRings(const PointTable& table) {
  for (const char* name : {"ring", "line", "channel", "laser_id", "laserid", "scan_id"}) {
    const Column* column = table.Find(name);
    if (column != nullptr && IsInteger(column->type)) return column;
  }
  return nullptr;
}

}  // namespace

void PointCounter::Add(const PointTable& table, const LidarScan& scan) {
  points_per_message_.push_back(scan.points.size());
  summary_.total += scan.points.size();
  summary_.empty_messages += scan.points.empty() ? 1 : 0;
  for (const LidarPoint& point : scan.points) {
    if (!point.xyz_m.allFinite()) {
      ++summary_.not_finite;
      continue;
    }
    const double range_m = point.xyz_m.cast<double>().norm();
    if (range_m == 0.0) {
      ++summary_.at_origin;
      continue;
    }
    const bool first = summary_.range_max_m == 0.0;
    summary_.range_min_m = first ? range_m : std::min(summary_.range_min_m, range_m);
    summary_.range_max_m = std::max(summary_.range_max_m, range_m);
    ++range_histogram_[RangeBin(range_m)];
    const double elevation_deg =
        std::asin(std::clamp(static_cast<double>(point.xyz_m.z()) / range_m, -1.0, 1.0)) * 180.0 /
        M_PI;
    ++elevation_histogram_[static_cast<std::size_t>(
        std::min(10.0 * (elevation_deg + 90.0), static_cast<double>(kElevationBins - 1)))];
  }
  const Column* rings = FindRings(table);
  if (rings == nullptr) return;
  has_rings_ = true;
  VisitColumn(table, *rings, 0, table.count, [&](std::size_t, auto value) {
    const auto ring = static_cast<double>(value);  // Of any type, and damaged files have any value.
    if (ring >= 0.0 && ring < static_cast<double>(rings_.size())) {
      rings_[static_cast<std::size_t>(ring)] = true;
    }
  });
}

std::size_t PointCounter::RangeBin(double range_m) {
  constexpr auto kNear = static_cast<double>(kNearBins);
  const double bin = range_m < kNearEnd_m ? 100.0 * range_m : kNear + 0.1 * (range_m - kNearEnd_m);
  return static_cast<std::size_t>(std::min(bin, static_cast<double>(kRangeBins - 1)));
}

double PointCounter::QuantileBin(const std::vector<std::uint64_t>& histogram, double share) const {
  const auto returns = static_cast<double>(summary_.Returns());
  double sum = 0.0;
  for (std::size_t bin = 0; bin < histogram.size(); ++bin) {
    sum += static_cast<double>(histogram[bin]);
    if (sum > 0.0 && sum >= share * returns) return static_cast<double>(bin);
  }
  return 0.0;
}

double PointCounter::RangeQuantile(double share) const {
  if (summary_.Returns() == 0) return 0.0;
  const double bin = QuantileBin(range_histogram_, share) + 0.5;
  constexpr auto kNear = static_cast<double>(kNearBins);
  const double middle_m = bin < kNear ? 0.01 * bin : kNearEnd_m + 10.0 * (bin - kNear);
  return std::clamp(middle_m, summary_.range_min_m, summary_.range_max_m);
}

double PointCounter::ElevationQuantile(double share) const {
  if (summary_.Returns() == 0) return 0.0;
  return 0.1 * (QuantileBin(elevation_histogram_, share) + 0.5) - 90.0;
}

PointSummary PointCounter::Summarise() const {
  PointSummary summary = summary_;
  if (!points_per_message_.empty()) {
    const auto [fewest, most] =
        std::minmax_element(points_per_message_.begin(), points_per_message_.end());
    summary.fewest = *fewest;
    summary.most = *most;
    summary.median = UpperMedian(points_per_message_);
  }
  summary.range_median_m = RangeQuantile(0.5);
  summary.range_99_m = RangeQuantile(0.99);
  summary.elevation_1_deg = ElevationQuantile(0.01);
  summary.elevation_99_deg = ElevationQuantile(0.99);
  if (has_rings_) {
    PointSummary::Rings rings;
    for (std::uint32_t ring = 0; ring < rings_.size(); ++ring) {
      if (!rings_[ring]) continue;
      if (rings.distinct++ == 0) rings.lowest = ring;
      rings.highest = ring;
    }
    summary.rings = rings;
  }
  return summary;
}

}  // namespace trajlo
