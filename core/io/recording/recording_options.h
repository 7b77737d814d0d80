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
#include "core/options/describe.h"

namespace trajlo {

/// One value for all LiDARs, or one for each.
template <typename T>
struct PerLidar {
  std::vector<T> values{T{}};  ///< Never empty.

  T Of(std::size_t lidar) const { return values[std::min(lidar, values.size() - 1)]; }
};

inline Names<std::optional<VelodyneModel>> VelodyneModelNames() {
  Names<std::optional<VelodyneModel>> names = {{"auto", std::nullopt}};
  for (const auto& [name, model] : kVelodyneModels) names.emplace_back(name, model);
  return names;
}

/// How a recording is read.
struct RecordingOptions {
  std::vector<std::string> topics;
  PerLidar<bool> use_point_times{{true}};
  PerLidar<std::string> time_field;
  PerLidar<TimeUnit> time_unit;
  PerLidar<TimeOrigin> time_origin;
  PerLidar<StampAt> stamp_at;
  PerLidar<double> clock_offset_s;
  std::filesystem::path stamps_file;
  double scan_period_s = 0.1;
  std::optional<VelodyneModel> velodyne_model;
  double start_s = 0.0;
  double duration_s = 0.0;

  TimeOptions TimeOf(std::size_t lidar) const {
    return {use_point_times.Of(lidar), time_field.Of(lidar), time_unit.Of(lidar),
            time_origin.Of(lidar), stamp_at.Of(lidar)};
  }

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kUsers, "topics", topics,
      "Topics of a bag to read, one per LiDAR; empty takes the only one with point clouds. Of "
      "several folders of scans, their names.");
    d(OptionFor::kUsers, "point_time", use_point_times,
      Names<bool>{{"auto", true}, {"none", false}},
      "none ignores the times of points, for motion-corrected scans; every point then gets its "
      "scan's stamp.");
    d(OptionFor::kUsers, "time_field", time_field,
      "Name of the field with the points' times; empty takes the first with a known name.");
    d(OptionFor::kUsers, "time_unit", time_unit,
      Names<TimeUnit>{{"auto", TimeUnit::kAuto},
                      {"s", TimeUnit::kSeconds},
                      {"ms", TimeUnit::kMilliseconds},
                      {"us", TimeUnit::kMicroseconds},
                      {"ns", TimeUnit::kNanoseconds}},
      "Unit of the points' times; auto decides by the first scans.");
    d(OptionFor::kUsers, "time_origin", time_origin,
      Names<TimeOrigin>{{"auto", TimeOrigin::kAuto},
                        {"start", TimeOrigin::kSweepStart},
                        {"stamp", TimeOrigin::kStamp},
                        {"end", TimeOrigin::kSweepEnd},
                        {"absolute", TimeOrigin::kAbsolute}},
      "What a point time of zero means: start or end of the sweep, the scan's stamp, or the "
      "zero of an absolute clock.");
    d(OptionFor::kUsers, "stamp_at", stamp_at,
      Names<StampAt>{{"auto", StampAt::kAuto}, {"start", StampAt::kStart}, {"end", StampAt::kEnd}},
      "Which end of the sweep a scan's stamp marks.");
    d(OptionFor::kUsers, "clock_offset_s", clock_offset_s, Range<double>{-1e9, 1e9},
      "Added to the stamps and times of a LiDAR whose clock is late by this much.");
    d(OptionFor::kUsers, "stamps_file", stamps_file,
      "File with one stamp a line; empty searches for timestamps.txt or times.txt. A relative path "
      "is below the folder of the configuration that names it; with --set, below the current one.");
    d(OptionFor::kUsers, "scan_period_s", scan_period_s, Range<double>{1e-3, 100.0},
      "Time between scans when nothing else gives stamps.");
    d(OptionFor::kUsers, "velodyne_model", velodyne_model, VelodyneModelNames(),
      "Model of a Velodyne whose packets do not name it (old firmware); auto refuses such a "
      "capture. VLP-16 also means the Puck LITE.");
    d(OptionFor::kUsers, "start_s", start_s, Range<double>{0.0, 1e9},
      "How much to skip at the start.");
    d(OptionFor::kUsers, "duration_s", duration_s, Range<double>{0.0, 1e9},
      "How much to read; 0 reads to the end.");
  }
};

}  // namespace trajlo
