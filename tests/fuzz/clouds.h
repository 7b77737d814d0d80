// SPDX-License-Identifier: MIT
// What must hold for every table of points that a reader gives, whatever the file.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/io/errors.h"
#include "core/io/messages/cloud_message.h"
#include "core/io/scan_decoder.h"
#include "tests/fuzz/fuzzing.h"

namespace trajlo::fuzz {

inline void RequireColumnsWithinBytes(const PointTable& table) {
  for (const Column& column : table.columns) {
    if (table.count == 0) continue;
    const std::size_t end = column.offset + (table.count - 1) * column.stride + SizeOf(column.type);
    Require(end <= table.bytes.size(), "every column lies within the bytes");
  }
}

/// Decodes the table as `convention` says: as many points, and none far from its scan.
inline void RequireDecodes(const PointTable& table, const TimeConvention& convention,
                           std::optional<std::int64_t> stamp_ns) {
  LidarScan scan;
  try {
    DecodeScan("input", table, convention, stamp_ns, &scan);
  } catch (const InputError&) {
    return;
  }
  Require(scan.points.size() == table.count, "a scan has as many points as its table");
  const double reach_ns = 1e9 + 11.0 * static_cast<double>(convention.sweep_ns);
  for (const LidarPoint& point : scan.points) {
    // As double: the difference may not fit.
    const double distance_ns = static_cast<double>(point.t_ns) - static_cast<double>(scan.stamp_ns);
    Require(std::abs(distance_ns) <= reach_ns, "no point is far from its scan in time");
  }
}

/// The same with every unit and origin, with the stamp and without it.
inline void RequireSound(const PointTable& table, std::optional<std::int64_t> stamp_ns) {
  RequireColumnsWithinBytes(table);
  TimeConvention convention;
  convention.sweep_ns = 100'000'000;
  if (const Column* time = FindTimeColumn(table, "")) {
    convention.field = time->name;
    SampleTimes(table, *time);
  }
  for (const TimeUnit unit : {TimeUnit::kSeconds, TimeUnit::kNanoseconds}) {
    for (const TimeOrigin origin : {TimeOrigin::kSweepEnd, TimeOrigin::kAbsolute}) {
      convention.unit = unit;
      convention.origin = origin;
      RequireDecodes(table, convention, stamp_ns);
      RequireDecodes(table, convention, std::nullopt);
    }
  }
}

/// Reads all clouds of a file. A file of `size` bytes has no more than a multiple of that many
/// points and messages, however its bytes contradict each other.
inline void RequireSound(CloudMessageReader* reader, std::size_t size) {
  std::size_t messages = 0;
  CloudMessage message;
  while (reader->Next(&message)) {
    Require(message.topic < reader->topics().size(), "a message is of a topic that is listed");
    RequireSound(message.table, message.stamp_ns);
    Require(++messages <= 100 * size, "a file ends");
    message = {};
  }
  Require(!reader->Next(&message), "the end stays the end");
}

}  // namespace trajlo::fuzz
