// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>

#include "core/io/scan_source.h"

namespace trajlo {

/// The scans of a recording from `start` after its begin on, for `duration`. Time is that of the
/// stamps; where one is more than a minute from that before it, by the same LiDAR, it does not
/// count.
class Excerpt : public ScanSource {
 public:
  /// A duration of 0 reads to the end.
  Excerpt(std::unique_ptr<ScanSource> whole, std::int64_t start_ns, std::int64_t duration_ns)
      : whole_(std::move(whole)), start_ns_(start_ns), duration_ns_(duration_ns) {
    UpdateReport();
  }

  bool Next(LidarScan* scan) override;
  /// Of the whole recording.
  std::size_t size() const override { return whole_->size(); }
  const std::string& description() const override { return whole_->description(); }
  /// Of the whole recording, as far as it was read, but what is counted as read is what was handed
  /// on. (Several inputs are each read one scan ahead, and so are their points without a time and
  /// those that are not declared.)
  const ReadReport& report() const override { return report_; }

 private:
  bool FindNext(LidarScan* scan);
  bool NextOfWhole(LidarScan* scan);
  std::int64_t ElapsedNs(const LidarScan& scan);
  void UpdateReport();

  std::unique_ptr<ScanSource> whole_;
  std::int64_t start_ns_, duration_ns_;

  /// Of each LiDAR, its last stamp and when that was.
  struct Clock {
    std::int64_t stamp_ns, elapsed_ns;
  };
  std::map<int, Clock> clocks_;
  int beyond_ = 0;  ///< Scans in a row that lie behind the end.
  std::size_t scans_ = 0, points_ = 0, points_without_time_ = 0;  ///< Handed on.
  std::size_t points_undeclared_ = 0;                             ///< Of these scans.
  /// Of the scan that was read last.
  std::size_t last_without_time_ = 0, last_undeclared_ = 0;
  ReadReport report_;
};

}  // namespace trajlo
