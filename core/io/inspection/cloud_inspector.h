// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/io/inspection/inspection.h"
#include "core/io/inspection/point_summary.h"
#include "core/io/inspection/sweep_times.h"
#include "core/io/messages/cloud_message.h"

namespace trajlo {

/// Looks at the messages of one LiDAR, one by one.
class CloudInspector {
 public:
  /// `known` says what is known before: topic, type, convention. Folders have no time of recording.
  CloudInspector(std::filesystem::path path, CloudInspection known, bool has_recorded_times)
      : path_(std::move(path)), found_(std::move(known)), has_recorded_times_(has_recorded_times) {}

  void Add(const CloudMessage& message);
  CloudInspection Summarise() const;
  const std::vector<std::int64_t>& sweep_begins_ns() const { return sweeps_.begins_ns(); }
  const std::vector<std::int64_t>& recorded_ns() const { return recorded_ns_; }

 private:
  std::filesystem::path path_;
  CloudInspection found_;
  bool has_recorded_times_;
  std::vector<std::int64_t> stamps_ns_, recorded_ns_;
  PointCounter points_;
  SweepTimes sweeps_;
  LidarScan scan_;
};

}  // namespace trajlo
