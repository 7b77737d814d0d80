// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/io/scan_source.h"

namespace trajlo {

/// Several recordings as one: their scans in the order of their stamps.
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
  };
  static void Fetch(Head* head);
  void UpdateReport();

  std::vector<Head> heads_;
  std::string description_;
  ReadReport report_;
};

}  // namespace trajlo
