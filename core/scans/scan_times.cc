// SPDX-License-Identifier: MIT
#include "core/scans/scan_times.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

namespace trajlo {
namespace {

constexpr std::int64_t kLatest = std::int64_t{1} << 62;
/// The middle of a scan is that of this many of its points.
constexpr std::size_t kSamples = 1024;

bool IsSane(std::int64_t t_ns) { return t_ns > -kLatest && t_ns < kLatest; }

/// True for a point that is somewhere: neither at zero nor not finite.
bool IsReturn(const LidarPoint& point) { return point.xyz_m.allFinite() && !point.xyz_m.isZero(); }

bool IsStray(const ScanTimes& times, const LidarPoint& point) {
  return !IsSane(point.t_ns) || point.t_ns < times.center_ns - times.reach_ns ||
         point.t_ns > times.center_ns + times.reach_ns;
}

/// Times of about kSamples points, in order; of points without a position only if there are no
/// others.
std::vector<std::int64_t> SampledTimes(const LidarScan& scan) {
  std::vector<std::int64_t> times;
  const std::size_t step = scan.points.size() / kSamples + 1;
  for (const bool all : {false, true}) {
    for (std::size_t i = 0; i < scan.points.size(); i += step) {
      const LidarPoint& point = scan.points[i];
      if (IsSane(point.t_ns) && (all || point.xyz_m.allFinite())) times.push_back(point.t_ns);
    }
    if (!times.empty()) break;
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// The scan without its strays.
std::optional<ScanTimes> MeasureMiddle(const LidarScan& scan, std::int64_t usual_ns) {
  const std::vector<std::int64_t> sampled = SampledTimes(scan);
  if (sampled.empty()) return std::nullopt;
  const std::int64_t half_spread_ns =
      sampled[(sampled.size() - 1) * 3 / 4] / 2 - sampled[sampled.size() / 4] / 2;
  ScanTimes times;
  times.center_ns = sampled[sampled.size() / 2];
  // The middle half of the points takes half of the time, or less.
  times.reach_ns = std::max(usual_ns, 8 * std::min(half_spread_ns, kLatest / 8));
  times.begin_ns = times.end_ns = times.center_ns;
  for (const LidarPoint& point : scan.points) {
    if (IsStray(times, point)) {
      ++times.strays;
      continue;
    }
    times.begin_ns = std::min(times.begin_ns, point.t_ns);
    times.end_ns = std::max(times.end_ns, point.t_ns);
  }
  return times;
}

}  // namespace

std::optional<ScanTimes> MeasureTimes(const LidarScan& scan, std::int64_t usual_ns) {
  if (!scan.has_point_times) {
    if (!IsSane(scan.stamp_ns)) return std::nullopt;
    return ScanTimes{scan.stamp_ns, scan.stamp_ns, 0, 0, 0};
  }
  if (scan.points.empty()) return std::nullopt;
  const auto [first, last] =
      std::minmax_element(scan.points.begin(), scan.points.end(),
                          [](const LidarPoint& a, const LidarPoint& b) { return a.t_ns < b.t_ns; });
  const bool is_usual =
      IsSane(first->t_ns) && IsSane(last->t_ns) && last->t_ns - first->t_ns <= usual_ns;
  if (!is_usual) return MeasureMiddle(scan, usual_ns);
  return ScanTimes{first->t_ns, last->t_ns, 0, 0, 0};
}

// Samples are taken among the returns: where every second point is missing, those at even places
// would be the same in all scans.
std::uint64_t Fingerprint(const LidarScan& scan) {
  std::uint64_t hash = scan.points.size();
  const auto returns = std::count_if(scan.points.begin(), scan.points.end(), IsReturn);
  const std::size_t step = static_cast<std::size_t>(returns) / kSamples + 1;
  std::size_t to_pass = 0;
  for (const LidarPoint& point : scan.points) {
    if (!IsReturn(point) || to_pass-- > 0) continue;
    to_pass = step - 1;
    std::uint32_t bits[3];
    std::memcpy(bits, point.xyz_m.data(), sizeof(bits));
    for (const std::uint32_t word : bits)
      hash = (hash ^ word) * 0x100000001B3ULL;  // FNV-1a's prime
  }
  return hash;
}

bool HasReturn(const LidarScan& scan) {
  return std::any_of(scan.points.begin(), scan.points.end(), IsReturn);
}

void RemoveStrays(const ScanTimes& times, LidarScan* scan) {
  if (times.strays == 0) return;
  const auto keep_end =
      std::remove_if(scan->points.begin(), scan->points.end(),
                     [&](const LidarPoint& point) { return IsStray(times, point); });
  scan->points.erase(keep_end, scan->points.end());
}

void ShiftTimes(std::int64_t shift_ns, LidarScan* scan) {
  if (shift_ns == 0) return;
  scan->stamp_ns += shift_ns;
  for (LidarPoint& point : scan->points) point.t_ns += shift_ns;
}

std::int64_t Sum(std::int64_t a, std::int64_t b) {
  std::int64_t sum = 0;
  if (!__builtin_add_overflow(a, b, &sum)) return sum;
  return a < 0 ? std::numeric_limits<std::int64_t>::min()
               : std::numeric_limits<std::int64_t>::max();
}

std::int64_t Difference(std::int64_t a, std::int64_t b) {
  std::int64_t difference = 0;
  if (!__builtin_sub_overflow(a, b, &difference)) return difference;
  return a < b ? std::numeric_limits<std::int64_t>::min()
               : std::numeric_limits<std::int64_t>::max();
}

std::int64_t Distance(std::int64_t a, std::int64_t b) {
  return a > b ? Difference(a, b) : Difference(b, a);
}

}  // namespace trajlo
