// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/io/inspection/point_summary.h"
#include "core/io/inspection/stamp_summary.h"
#include "core/io/messages/raw_message.h"
#include "core/io/packets/velodyne_model.h"
#include "core/io/time_convention.h"

namespace trajlo {

/// Where the sweeps lie in time, from the times of their points as the convention understands them.
struct SweepSummary {
  /// From the first to the last point of a sweep; median, s.
  double span_s = 0.0;
  /// From the last point of a sweep to the first of the next, where no scan is missing between
  /// them; median, s. Far from zero means that the convention is wrong (or a narrow field of view).
  double pause_s = 0.0;
  /// From the first and the last point of a sweep to its stamp; medians, s.
  double stamp_after_first_s = 0.0;
  double stamp_after_last_s = 0.0;
  /// Points whose time is impossible; trajlo_run drops them.
  std::size_t points_without_time = 0;
};

/// The sweeps of a LiDAR against those of the first LiDAR of the recording.
struct SweepPhase {
  /// From the start of a sweep of the first LiDAR to the start of one of this; median, s.
  double after_first_lidar_s = 0.0;
  /// The largest less the smallest: near zero for LiDARs that are locked to each other.
  double spread_s = 0.0;
};

struct FieldDescription {
  std::string name;
  /// "float32"
  std::string type;
  /// Bytes from the first field of a point.
  std::size_t offset = 0;
};

/// The point clouds of one topic or folder: one LiDAR.
struct CloudInspection {
  std::string topic, type;
  /// See Topic::remark.
  std::string remark;
  std::size_t messages_listed = 0;
  std::size_t messages_read = 0;
  /// Messages without positions, and why the first is one.
  std::size_t messages_unreadable = 0;
  std::string first_unreadable;
  /// Messages that hold fewer points than they say, and what the first says.
  std::size_t messages_damaged = 0;
  std::string first_damage;
  /// All that occur, in the order of appearance.
  std::vector<std::string> frame_ids;
  std::vector<FieldDescription> fields;
  TimeConvention convention;
  /// Why no convention could be decided, and what to do; empty if one was.
  std::string time_problem;
  /// The headers' stamps are not filled: the time of recording stands for them.
  bool stamp_is_recorded = false;
  /// Stamps are an even count of scans, because nothing else gives any.
  bool stamp_is_assumed = false;
  StampSummary stamps;
  PointSummary points;
  std::optional<SweepSummary> sweeps;
  std::optional<SweepPhase> phase;
};

/// What a recording holds and how trajlo_run will understand it.
struct RecordingInspection {
  std::string path;
  /// A config with extrinsics that lies in the recording's folder, as simulated ones have it.
  std::string rig_config;
  /// As it was told, for packets that do not name it.
  std::optional<VelodyneModel> velodyne_model;
  /// All topics of the file; those with clouds come again in `clouds`.
  std::vector<Topic> topics;
  std::vector<CloudInspection> clouds;
  /// Of the clouds' messages by the recorder's clock, else of their stamps, s.
  double duration_s = 0.0;
  /// Only the first messages were read.
  bool is_quick = false;
  /// A part could not be read.
  bool damaged = false;
  std::uint64_t bytes_lost = 0;
  std::vector<std::string> warnings;

  /// There are LiDARs, and none has measured anything: trajlo_run would refuse.
  bool IsWithoutReturns() const {
    return !clouds.empty() && std::all_of(clouds.begin(), clouds.end(), [](const auto& cloud) {
      return cloud.points.Returns() == 0;
    });
  }
};

}  // namespace trajlo
