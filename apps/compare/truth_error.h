// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/evaluation/timed_poses.h"
#include "core/io/trajectory_reader.h"

namespace trajlo {

/// Reads the truth; throws InputError.
TimedPoses ReadTruth(const std::filesystem::path& path);

/// The root mean square of the position errors after SE(3) alignment, m.
/// Throws EvaluationError if the two cannot be compared.
double PositionError(const TimedPoses& truth, const std::vector<StampedPose>& estimate);

}  // namespace trajlo
