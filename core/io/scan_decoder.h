// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/point_table.h"
#include "core/io/time_convention.h"
#include "core/scans/lidar_scan.h"

namespace trajlo {

/// The column with the points' times: the one named `wanted`, or the first with a known name
/// (t, time, timestamp, offset_time, ...) if `wanted` is empty. Null if there is none.
const Column* FindTimeColumn(const PointTable& table, const std::string& wanted);

/// All columns with such a name, the most usual first.
std::vector<const Column*> TimeColumns(const PointTable& table);

/// The range of a time column over the points that are real returns (finite, not the origin);
/// nothing if there are none with a finite time.
std::optional<TimeSample> SampleTimes(const PointTable& table, const Column& column);

/// Converts a table to `scan->points` (times in ns, absolute) and sets `scan->stamp_ns` and
/// `scan->has_point_times`. Where times are absolute, the earliest is taken as the stamp if there
/// is none, or if it is far from them; without absolute times there must be one. A point whose time
/// is not finite, or so far from its scan that it must be wrong, gets the stamp as its time and NaN
/// as its position, so that it is dropped as one. Returns how many there were. Throws InputError if
/// x, y or z is missing, or every source of a stamp.
std::size_t DecodeScan(const std::filesystem::path& path, const PointTable& table,
                       const TimeConvention& convention, std::optional<std::int64_t> stamp_ns,
                       LidarScan* scan);

}  // namespace trajlo
