// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/io/scan_source.h"

namespace trajlo {

/// The scans of a recording whose stamps lie in [first + start, first + start + duration), where
/// `first` is the stamp of its first scan.
class Excerpt : public ScanSource {
 public:
  /// A duration of 0 reads to the end.
  Excerpt(std::unique_ptr<ScanSource> whole, std::int64_t start_ns, std::int64_t duration_ns)
      : whole_(std::move(whole)), start_ns_(start_ns), duration_ns_(duration_ns) {}

  bool Next(LidarScan* scan) override;
  /// Of the whole recording.
  std::size_t size() const override { return whole_->size(); }
  const std::string& description() const override { return whole_->description(); }
  const ReadReport& report() const override { return whole_->report(); }

 private:
  std::unique_ptr<ScanSource> whole_;
  std::int64_t start_ns_, duration_ns_;
  std::optional<std::int64_t> first_ns_;
};

}  // namespace trajlo
