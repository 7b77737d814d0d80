// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/odometry/trajectory/trajectory.h"

namespace trajlo {

struct ResultOptions {
  /// Poses from where the estimator got lost are not to be trusted and are left out, unless this is
  /// set.
  bool keep_lost = false;
};

/// What trajlo_run left in a folder, as far as it is needed to place the recording's points.
struct RunResult {
  /// The recording where it was; if it is not there any more, as the command line named it.
  std::vector<std::string> inputs;
  RunConfig config;  ///< With the extrinsics that were found.
  /// Of config.yaml, those that an older build knew.
  std::vector<std::string> unknown_keys;
  /// The poses of trajectory.tum that count, with the flags of windows.csv; never empty.
  Trajectory trajectory;
  /// By time; empty unless the run was asked for covariance.csv.
  std::map<std::int64_t, Matrix6d> covariances;
  /// Scans that the run read, if it came to the end of the recording.
  std::optional<std::size_t> scans_read;
  std::optional<std::int64_t> lost_at_ns;
  std::size_t poses_left_out = 0;
  /// False if trajectory.tum has poses at other times than those that were estimated (--rate,
  /// --at): then the motion in between is known less well.
  bool has_control_poses = true;
};

/// True for a folder with a trajectory.tum and a run.json.
bool IsRunResult(const std::filesystem::path& folder);

/// What run.json of a result says against its poses: the run was lost, cut short or killed, or read
/// only a part of its input. Empty after a run that ended well.
std::string RunShortcoming(const std::filesystem::path& folder);

/// Throws InputError where a file is missing or no pose counts, and ConfigError for config.yaml.
RunResult ReadRunResult(const std::filesystem::path& folder, const ResultOptions& options = {});

}  // namespace trajlo
