// SPDX-License-Identifier: MIT
#include "apps/python/module/make_scan.h"

#include <cmath>
#include <string>

#include "apps/python/module/arrays.h"
#include "apps/python/module/errors.h"
#include "core/scans/nanoseconds.h"

namespace trajlo::python {
namespace {

namespace py = pybind11;

/// Times of points count from the stamp; more than a minute is no sweep, but another unit or an
/// absolute time.
constexpr double kLongest_s = 60.0;
/// A calendar's worth, as for recordings: the year 2116.
constexpr std::int64_t kLatest_ns = std::int64_t{1} << 62;
constexpr std::int64_t kMaxLidar = 1000;

void RequireLength(std::size_t found, std::size_t points, const std::string& name) {
  if (found == points) return;
  throw DataError(name + ": must have one element for each of the " + std::to_string(points) +
                  " points, found " + std::to_string(found));
}

std::int64_t ReadStamp(const py::object& stamp) {
  const std::string found = py::repr(stamp);
  if (PyFloat_Check(stamp.ptr()) != 0) {
    throw py::type_error("stamp_ns: must be a whole number of nanoseconds, found " + found +
                         "; a float is exact to 256 ns only, a second since 1970 is "
                         "int(seconds) * 10**9");
  }
  if (PyIndex_Check(stamp.ptr()) == 0) {
    throw py::type_error("stamp_ns: must be a whole number of nanoseconds, found " + found);
  }
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(stamp.ptr()));
  if (!number) throw py::error_already_set();
  int overflow = 0;
  const long long stamp_ns = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0 || stamp_ns < -kLatest_ns || stamp_ns > kLatest_ns) {
    throw DataError("stamp_ns: must be within ±2^62 ns, found " + found);
  }
  return stamp_ns;
}

/// A time that is not finite tells nothing, which is fine for points that tell nothing either.
std::int64_t OffsetNs(double time_s, const LidarPoint& point, std::size_t index) {
  if (std::isfinite(time_s) && std::abs(time_s) <= kLongest_s) return Nanoseconds(time_s);
  if (!std::isfinite(time_s) && !point.xyz_m.allFinite()) return 0;
  throw DataError("times_s[" + std::to_string(index) +
                  "]: must be seconds after the stamp, at most " + "60, found " +
                  std::to_string(time_s) +
                  (std::isfinite(time_s) ? "; absolute times are times_ns" : ""));
}

void SetTimes(const ScanArrays& arrays, LidarScan* scan) {
  if (!arrays.times_s.is_none() && !arrays.times_ns.is_none()) {
    throw DataError("give times_s or times_ns, not both");
  }
  std::vector<LidarPoint>& points = scan->points;
  scan->has_point_times = !arrays.times_s.is_none() || !arrays.times_ns.is_none();
  for (LidarPoint& point : points) point.t_ns = scan->stamp_ns;
  if (!arrays.times_s.is_none()) {
    const std::vector<double> times_s = ReadReals(arrays.times_s, "times_s");
    RequireLength(times_s.size(), points.size(), "times_s");
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].t_ns += OffsetNs(times_s[i], points[i], i);
    }
    RequireFineSeconds(arrays.times_s, "times_s", " or times_ns");
  } else if (!arrays.times_ns.is_none()) {
    const std::vector<std::int64_t> times_ns = ReadIntegers(arrays.times_ns, "times_ns");
    RequireLength(times_ns.size(), points.size(), "times_ns");
    for (std::size_t i = 0; i < points.size(); ++i) points[i].t_ns = times_ns[i];
  }
}

}  // namespace

LidarScan MakeScan(const ScanArrays& arrays) {
  if (arrays.lidar < 0 || arrays.lidar > kMaxLidar) {
    throw DataError("lidar: must be a number from 0 to " + std::to_string(kMaxLidar) + ", found " +
                    std::to_string(arrays.lidar));
  }
  LidarScan scan;
  scan.lidar_id = static_cast<int>(arrays.lidar);
  scan.stamp_ns = ReadStamp(arrays.stamp_ns);
  const bool has_intensities = ReadPoints(arrays.points, &scan.points);
  if (has_intensities && !arrays.intensities.is_none()) {
    throw DataError("points: have intensities, (N, 4), and intensities are given as well");
  }
  SetTimes(arrays, &scan);
  if (!arrays.intensities.is_none()) {
    const std::vector<double> values = ReadReals(arrays.intensities, "intensities");
    RequireLength(values.size(), scan.points.size(), "intensities");
    for (std::size_t i = 0; i < values.size(); ++i) {
      scan.points[i].intensity = static_cast<float>(values[i]);
    }
  }
  return scan;
}

}  // namespace trajlo::python
