// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/io/scan_source.h"

namespace trajlo {

/// Several recordings as one: their scans in the order in which they were recorded where all of
/// them say so (folders with record_times.txt), else in the order of their stamps. Bags do not say
/// so: of two recorders, the clocks need not agree.
class MergedRecording : public ScanSource {
 public:
  explicit MergedRecording(std::vector<std::unique_ptr<ScanSource>> sources);

  bool Next(LidarScan* scan) override;
  std::size_t size() const override;
  const std::string& description() const override { return description_; }
  const ReadReport& report() const override { return report_; }

 private:
  struct Head {
    std::unique_ptr<ScanSource> source;
    LidarScan scan;
    bool filled;
    /// Of `scan`: its order among the others.
    std::int64_t order_ns;
    /// How many of its source are in the report.
    std::size_t warnings;
  };
  void SetOrder(Head* head) const;
  void UpdateReport();

  std::vector<Head> heads_;
  bool by_record_times_ = false;
  std::string description_;
  ReadReport report_;
};

}  // namespace trajlo
