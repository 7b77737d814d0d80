// SPDX-License-Identifier: MIT
#pragma once

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
    UpdateReport(0, 0);
  }

  bool Next(LidarScan* scan) override;
  /// Of the whole recording.
  std::size_t size() const override { return whole_->size(); }
  const std::string& description() const override { return whole_->description(); }
  /// Of the whole recording, as far as it was read; scans and points are those handed on.
  const ReadReport& report() const override { return report_; }

 private:
  std::unique_ptr<ScanSource> whole_;
  std::int64_t start_ns_, duration_ns_;
  bool FindNext(LidarScan* scan);
  std::int64_t ElapsedNs(const LidarScan& scan);
  void UpdateReport(std::size_t scans, std::size_t points);

  /// Of each LiDAR, its last stamp and when that was.
  struct Clock {
    std::int64_t stamp_ns;
    std::int64_t elapsed_ns;
  };
  std::map<int, Clock> clocks_;
  int beyond_ = 0;  ///< Scans in a row that lie behind the end.
  ReadReport report_;
};

}  // namespace trajlo
