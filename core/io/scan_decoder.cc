// SPDX-License-Identifier: MIT
#include "core/io/scan_decoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/io/errors.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

constexpr const char* kTimeNames[] = {"t",
                                      "time",
                                      "timestamp",
                                      "timestamps",
                                      "offset_time",
                                      "time_offset",
                                      "ts",
                                      "t_ns",
                                      "time_ns",
                                      "point_time",
                                      "time_stamp",
                                      "timestamp_ns",
                                      "t_us",
                                      "time_us",
                                      "gps_time",
                                      "gpstime",
                                      "point_timestamp",
                                      "deltatime",
                                      "delta_time",
                                      "time_offset_ns",
                                      "offset_time_ns",
                                      "timeoffset",
                                      "point_time_offset",
                                      "stamp"};
constexpr const char* kIntensityNames[] = {"intensity", "i",           "reflectivity",
                                           "remission", "reflectance", "signal"};

/// Points are converted field by field in blocks that stay in the cache.
constexpr std::size_t kBlock = 4096;
constexpr std::int64_t kNoTime = std::numeric_limits<std::int64_t>::min();

template <std::size_t N>
const Column* FindAny(const PointTable& table, const char* const (&names)[N]) {
  for (const char* name : names) {
    if (const Column* column = table.Find(name)) return column;
  }
  return nullptr;
}

struct PositionColumns {
  const Column* axis[3];
};

PositionColumns FindPosition(const std::filesystem::path& path, const PointTable& table) {
  const PositionColumns columns{{table.Find("x"), table.Find("y"), table.Find("z")}};
  for (const Column* column : columns.axis) {
    if (column != nullptr) continue;
    throw InputError(path,
                     "a scan needs the fields x, y and z, but this file has: " + table.FieldNames(),
                     "Rename the fields of the file.");
  }
  return columns;
}

/// value * unit in ns; kNoTime if that is not a time.
template <typename T>
std::int64_t ToNs(T value, std::int64_t unit_ns) {
  if constexpr (std::is_integral_v<T>) {
    std::int64_t ns = 0;
    if (__builtin_mul_overflow(value, unit_ns, &ns)) return kNoTime;
    return ns;
  } else {
    // The whole part separately: 1.6e9 s in ns has more digits than a double.
    const double limit = 9e18 / static_cast<double>(unit_ns);
    const auto number = static_cast<double>(value);
    if (!(number > -limit && number < limit)) return kNoTime;
    const auto whole = static_cast<std::int64_t>(number);
    const double rest = (number - static_cast<double>(whole)) * static_cast<double>(unit_ns);
    return whole * unit_ns + static_cast<std::int64_t>(rest + (rest < 0.0 ? -0.5 : 0.5));
  }
}

/// Farther than this from its scan, a time is a broken number.
std::int64_t ReachNs(const TimeConvention& convention) {
  return 1'000'000'000 + 10 * convention.sweep_ns;
}

/// The median of the raw times, which one broken time does not move; nothing if there are none.
std::optional<std::int64_t> MiddleTime(const LidarScan& scan) {
  std::vector<std::int64_t> times;
  times.reserve(scan.points.size());
  for (const LidarPoint& point : scan.points) {
    if (point.t_ns != kNoTime && point.xyz_m.allFinite()) times.push_back(point.t_ns);
  }
  if (times.empty()) return {};
  return UpperMedian(std::move(times));
}

bool IsWithin(std::int64_t reach_ns, std::int64_t a_ns, std::int64_t b_ns) {
  std::int64_t distance_ns = 0;
  return !__builtin_sub_overflow(a_ns, b_ns, &distance_ns) && distance_ns < reach_ns &&
         distance_ns > -reach_ns;
}

/// The median of absolute times in the clock of the recording; nothing if there are none, or if it
/// is beyond any calendar.
std::optional<std::int64_t> CenterNs(const TimeConvention& convention, const LidarScan& scan) {
  const auto middle_ns = MiddleTime(scan);
  std::int64_t center_ns = 0;
  if (!middle_ns || __builtin_add_overflow(*middle_ns, convention.clock_offset_ns, &center_ns)) {
    return {};
  }
  constexpr std::int64_t kFar = std::int64_t{1} << 62;
  if (!IsWithin(kFar, center_ns, 0) || !IsWithin(kFar, *middle_ns, 0)) return {};
  return center_ns;
}

/// The stamp of a scan whose times are absolute: the given one if it is near them, as it may be
/// missing or wrong, else the earliest of them.
std::optional<std::int64_t> StampNs(const TimeConvention& convention,
                                    std::optional<std::int64_t> given_ns, const LidarScan& scan) {
  const auto center_ns = CenterNs(convention, scan);
  const std::int64_t reach_ns = ReachNs(convention);
  if (!center_ns || (given_ns && IsWithin(reach_ns / 2, *given_ns, *center_ns))) return given_ns;
  const std::int64_t middle_ns = *center_ns - convention.clock_offset_ns;
  std::int64_t earliest_ns = middle_ns;
  for (const LidarPoint& point : scan.points) {
    if (point.t_ns == kNoTime || !point.xyz_m.allFinite() || point.t_ns >= earliest_ns) continue;
    if (IsWithin(reach_ns, point.t_ns, middle_ns)) earliest_ns = point.t_ns;
  }
  return earliest_ns + convention.clock_offset_ns;
}

/// Moves raw times (ns since the file's zero) to the clock of the recording and disarms the
/// impossible ones.
std::size_t PlaceTimes(const TimeConvention& convention, std::int64_t stamp_ns, LidarScan* scan) {
  const std::int64_t reach_ns = ReachNs(convention);
  std::int64_t zero_ns = convention.clock_offset_ns;
  // A stamp at the end of what 64 bits hold has no times after it.
  const bool has_zero = convention.IsAbsolute() ||
                        !__builtin_add_overflow(stamp_ns, convention.ZeroAfterStampNs(), &zero_ns);
  std::size_t broken = 0;
  for (LidarPoint& point : scan->points) {
    std::int64_t t_ns = 0;
    const bool fits = has_zero && !__builtin_add_overflow(point.t_ns, zero_ns, &t_ns);
    if (point.t_ns != kNoTime && fits && IsWithin(reach_ns, t_ns, stamp_ns)) {
      point.t_ns = t_ns;
      continue;
    }
    if (point.xyz_m.allFinite()) ++broken;
    point.t_ns = stamp_ns;
    point.xyz_m.setConstant(std::numeric_limits<float>::quiet_NaN());
  }
  return broken;
}

}  // namespace

const Column* FindTimeColumn(const PointTable& table, const std::string& wanted) {
  return wanted.empty() ? FindAny(table, kTimeNames) : table.Find(wanted);
}

std::vector<const Column*> TimeColumns(const PointTable& table) {
  std::vector<const Column*> columns;
  for (const char* name : kTimeNames) {
    if (const Column* column = table.Find(name)) columns.push_back(column);
  }
  return columns;
}

std::optional<TimeSample> SampleTimes(const PointTable& table, const Column& column) {
  // NaN until proven otherwise: drivers write time 0 for directions without a return.
  std::vector<float> size(table.count, 0.0F);
  for (const char* axis : {"x", "y", "z"}) {
    const Column* coordinate = table.Find(axis);
    if (coordinate == nullptr) return {};
    VisitColumn(table, *coordinate, 0, table.count,
                [&](std::size_t i, auto value) { size[i] += std::abs(static_cast<float>(value)); });
  }
  std::vector<double> times;
  VisitColumn(table, column, 0, table.count, [&](std::size_t i, auto value) {
    const auto time = static_cast<double>(value);
    if (size[i] > 0.0F && std::isfinite(size[i]) && std::isfinite(time)) times.push_back(time);
  });
  if (times.empty()) return {};
  std::sort(times.begin(), times.end());
  // Of times that are spread evenly, five sweeps to either side.
  const double middle = times[times.size() / 2];
  const double reach = 10.0 * (times[times.size() * 3 / 4] - times[times.size() / 4]);
  const auto first = std::lower_bound(times.begin(), times.end(), middle - reach);
  const auto last = std::upper_bound(times.begin(), times.end(), middle + reach) - 1;
  return TimeSample{*first, *last, times.size(), {}, {}};
}

std::size_t DecodeScan(const std::filesystem::path& path, const PointTable& table,
                       const TimeConvention& convention, std::optional<std::int64_t> stamp_ns,
                       LidarScan* scan) {
  const PositionColumns position = FindPosition(path, table);
  const Column* intensity = FindAny(table, kIntensityNames);
  const Column* time =
      convention.HasPointTimes() ? FindTimeColumn(table, convention.field) : nullptr;
  const std::int64_t unit_ns = NanosecondsPer(convention.unit);
  scan->has_point_times = time != nullptr;
  scan->points.resize(table.count);
  LidarPoint* points = scan->points.data();
  for (std::size_t begin = 0; begin < table.count; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, table.count);
    for (int axis = 0; axis < 3; ++axis) {
      VisitColumn(table, *position.axis[axis], begin, end, [&](std::size_t i, auto value) {
        points[i].xyz_m[axis] = static_cast<float>(value);
      });
    }
    if (intensity != nullptr) {
      VisitColumn(table, *intensity, begin, end, [&](std::size_t i, auto value) {
        points[i].intensity = static_cast<float>(value);
      });
    } else {
      for (std::size_t i = begin; i < end; ++i) points[i].intensity = 0.0F;
    }
    if (time != nullptr) {
      VisitColumn(table, *time, begin, end,
                  [&](std::size_t i, auto value) { points[i].t_ns = ToNs(value, unit_ns); });
    }
  }
  if (time != nullptr && convention.IsAbsolute()) stamp_ns = StampNs(convention, stamp_ns, *scan);
  if (!stamp_ns) {
    throw InputError(path, "no point has a time, and the scan has no stamp", "");
  }
  scan->stamp_ns = *stamp_ns;
  if (time != nullptr) return PlaceTimes(convention, *stamp_ns, scan);
  for (LidarPoint& point : scan->points) point.t_ns = scan->stamp_ns;
  return 0;
}

}  // namespace trajlo
