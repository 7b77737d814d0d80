// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scans/lidar_scan.h"

namespace trajlo {

/// What happened so far while a recording was read.
struct ReadReport {
  std::size_t scans_listed = 0;
  /// Handed on, whole or in part.
  std::size_t scans_read = 0;
  /// Handed on in part.
  std::size_t scans_damaged = 0;
  /// Nothing could be read.
  std::size_t scans_skipped = 0;
  /// Not listed: files of another format in the folder of the scans.
  std::size_t scans_left_out = 0;
  /// A part of the file is missing or broken, with an unknown number of scans in it.
  bool file_is_cut = false;
  /// Topics of a bag that were chosen, and of which there is no message.
  std::vector<std::string> topics_without_messages;
  std::size_t points_read = 0;
  /// Points among them that were disarmed (position NaN) because their time was impossible.
  std::size_t points_without_time = 0;
  /// Not read: points behind those that the header of their scan declares.
  std::size_t points_undeclared = 0;
  /// One sentence each, with file and numbers.
  std::vector<std::string> warnings;

  /// More than 5 % of the points that are there were not read, as no header declares them.
  bool MissesPoints() const { return 19 * points_undeclared > points_read; }
  /// True if the result rests on a part of the input only: exit code 3.
  bool IsPartial() const {
    return file_is_cut || scans_damaged + scans_skipped + scans_left_out > 0 || MissesPoints() ||
           !topics_without_messages.empty();
  }
};

/// A recording of one or several LiDARs, scan by scan.
class ScanSource {
 public:
  virtual ~ScanSource() = default;

  /// Fills `scan` with the next scan and reuses its memory; false at the end.
  virtual bool Next(LidarScan* scan) = 0;
  /// When the scan that came last was recorded, where a folder says so: its order among those of
  /// other folders.
  virtual std::optional<std::int64_t> recorded_ns() const { return {}; }
  /// Scans that the recording lists, broken ones included.
  virtual std::size_t size() const = 0;
  /// What is read and how it is understood (stamps, times), to be printed; several lines.
  virtual const std::string& description() const = 0;
  virtual const ReadReport& report() const = 0;
};

}  // namespace trajlo
