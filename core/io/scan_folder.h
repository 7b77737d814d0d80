// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>
#include <string>
#include <vector>

#include "core/io/scan_listing.h"
#include "core/io/scan_source.h"
#include "core/io/scan_stamps.h"
#include "core/io/time_convention.h"

namespace trajlo {

struct ScanFolderOptions {
  /// Written to every scan.
  int lidar_id = 0;
  TimeOptions time;
  /// Explicit stamps file; empty: search for one.
  std::filesystem::path stamps_file;
  /// Added to all stamps and times.
  std::int64_t clock_offset_ns = 0;
  /// Time between scans when nothing else gives stamps.
  double scan_period_s = 0.1;
  /// Goes into the warnings, if it is not empty.
  std::string remark;
  /// Decode the next scan in the background while the present one is worked on.
  bool read_ahead = true;
};

/// A recording that is a folder of .pcd, .ply or .bin scans.
/// The constructor lists the files, finds the stamps and decides the time convention from the
/// first readable scans; it throws InputError if any of that fails. After that no file can stop
/// the reading: a damaged one gives the points that are there, an unreadable one is skipped, and
/// both are counted in `report()` with a warning.
class ScanFolder : public ScanSource {
 public:
  explicit ScanFolder(const std::filesystem::path& path, const ScanFolderOptions& options = {});
  // The background decoding holds a pointer to this object.
  ScanFolder(const ScanFolder&) = delete;
  ScanFolder& operator=(const ScanFolder&) = delete;

  bool Next(LidarScan* scan) override;
  std::optional<std::int64_t> recorded_ns() const override;
  std::size_t size() const override { return listing_.files.size(); }
  const std::string& description() const override { return description_; }
  const ReadReport& report() const override { return report_; }

  const TimeConvention& time_convention() const { return convention_; }
  /// The files in their order.
  const ScanListing& listing() const { return listing_; }
  /// One for each file, or none if the points' times give the stamps.
  const ScanStamps& stamps() const { return stamps_; }
  /// Nothing gave stamps: a scan every `scan_period_s` (or sweep) is assumed.
  bool has_assumed_stamps() const { return has_assumed_stamps_; }

 private:
  /// What became of one file.
  struct Outcome {
    std::size_t index = 0;
    LidarScan scan;
    std::size_t points_without_time = 0;
    std::size_t points_undeclared = 0;
    bool readable = false;
    std::string damage;
  };

  void Warn(const std::vector<std::string>& warnings);
  void Probe();
  void SetRegularStamps();
  void Describe(const std::filesystem::path& path);
  void CountPoints(const Outcome& outcome, std::size_t points);
  Outcome Decode(std::size_t index, LidarScan reused) const;
  void StartNext(LidarScan reused);

  ScanFolderOptions options_;
  ScanListing listing_;
  ScanStamps stamps_;
  /// See FindRecordTimes.
  std::vector<std::int64_t> recorded_ns_;
  bool has_assumed_stamps_ = false;
  TimeConvention convention_;
  std::string description_;
  ReadReport report_;
  std::size_t next_ = 0;
  /// The file of the scan that came last.
  std::size_t last_ = 0;
  /// Declared last: its destructor waits for a decoding that uses the members above.
  std::future<Outcome> ahead_;
};

}  // namespace trajlo
