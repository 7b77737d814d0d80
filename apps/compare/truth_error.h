// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/timed_poses.h"
#include "core/io/trajectory_reader.h"

namespace trajlo {

/// A run against the truth.
struct TruthError {
  /// Root mean square of the position errors after SE(3) alignment, m. Nothing if the two cannot be
  /// compared; `failure` says why.
  std::optional<double> ate_rmse_m;
  std::string failure;
  std::size_t pairs = 0;
  double covered_share = 0.0;  ///< Of the time of the run.
  /// What makes the comparison doubtful, as trajlo_evaluate says it.
  std::vector<std::string> warnings;
};

/// Reads the truth; what is odd about the file goes to `warnings`. Throws InputError.
TimedPoses ReadTruth(const std::filesystem::path& path, std::vector<std::string>* warnings);

TruthError CompareWithTruth(const TimedPoses& truth, const std::vector<StampedPose>& estimate);

}  // namespace trajlo
