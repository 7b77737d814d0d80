// SPDX-License-Identifier: MIT
#include "core/scans/sight_lines.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace trajlo {
namespace {

constexpr float kCellsPerUnit = 50.0F;
/// Nearer points are of the carrier.
constexpr float kNear_m = 0.5F;
constexpr float kBehind = 1.2F;
/// This many points are a thing.
constexpr std::size_t kThing = 2;
/// Half way between scans as measured and registered clouds.
constexpr double kCrossed = 0.17;
/// With fewer directions, chance decides.
constexpr std::int64_t kFewest = 100;

/// The cell of a direction, spread so that its highest bits choose an eighth of all.
std::uint64_t CellOf(const Eigen::Vector3f& direction) {
  const Eigen::Vector3i cell = (kCellsPerUnit * direction).array().floor().cast<int>();
  const auto number =
      static_cast<std::uint64_t>(((cell.x() + 64) * 128 + cell.y() + 64) * 128 + cell.z() + 64);
  return number * 0x9E3779B97F4A7C15U;
}

}  // namespace

void SightLines::Add(const LidarScan& scan) {
  std::vector<std::pair<std::uint64_t, float>> ranges_m;
  for (const LidarPoint& point : scan.points) {
    const float range_m = point.xyz_m.norm();
    if (!(range_m > kNear_m) || !point.xyz_m.allFinite()) continue;
    const std::uint64_t cell = CellOf(point.xyz_m / range_m);
    if (cell >> 61U == 0) ranges_m.emplace_back(cell, range_m);
  }
  std::sort(ranges_m.begin(), ranges_m.end());
  for (auto begin = ranges_m.begin(); begin != ranges_m.end();) {
    const auto end = std::find_if(begin, ranges_m.end(),
                                  [&](const auto& one) { return one.first != begin->first; });
    if (static_cast<std::size_t>(end - begin) >= 2 * kThing) {
      ++asked;
      const float near_m = begin[kThing - 1].second;
      const float far_m = (end - static_cast<std::ptrdiff_t>(kThing))->second;
      with_two_things += far_m > kBehind * near_m ? 1 : 0;
    }
    begin = end;
  }
}

double SightLines::Share() const {
  return asked > 0 ? static_cast<double>(with_two_things) / static_cast<double>(asked) : 0.0;
}

bool SightLines::AreCrossed() const { return asked >= kFewest && Share() > kCrossed; }

}  // namespace trajlo
