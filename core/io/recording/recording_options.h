// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/packets/velodyne_model.h"
#include "core/io/time_convention.h"

namespace trajlo {

/// One value for all LiDARs, or one for each; the last holds for all LiDARs beyond the list.
template <typename T>
struct PerLidar {
  std::vector<T> values{T{}};  ///< Never empty.

  T Of(std::size_t lidar) const { return values[std::min(lidar, values.size() - 1)]; }
};

/// How a recording is read.
struct RecordingOptions {
  /// The topics of a bag to read, one per LiDAR; empty takes the only one that has point clouds.
  std::vector<std::string> topics;
  /// What is fixed about the points' times; the rest is decided by evidence.
  PerLidar<bool> use_point_times{{true}};
  PerLidar<std::string> time_field;
  PerLidar<TimeUnit> time_unit;
  PerLidar<TimeOrigin> time_origin;
  PerLidar<StampAt> stamp_at;
  /// Added to the stamps and times of a LiDAR whose clock is late by this much.
  PerLidar<double> clock_offset_s;
  /// Explicit stamps file of a folder of scans; empty: search for one.
  std::filesystem::path stamps_file;
  /// Time between the scans of a folder when nothing else gives stamps.
  double scan_period_s = 0.1;
  /// Of the sensors in a capture whose packets do not name it (old firmware).
  std::optional<VelodyneModel> velodyne_model;
  /// Scans before this much time since the first are skipped.
  double start_s = 0.0;
  /// The length of what is read; 0 reads to the end.
  double duration_s = 0.0;

  TimeOptions TimeOf(std::size_t lidar) const {
    return {use_point_times.Of(lidar), time_field.Of(lidar), time_unit.Of(lidar),
            time_origin.Of(lidar), stamp_at.Of(lidar)};
  }
};

}  // namespace trajlo
