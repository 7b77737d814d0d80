// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "apps/convert/convert_job.h"
#include "apps/exit_code.h"
#include "core/io/trajectory_reader.h"

namespace trajlo {

/// Poses as the name of the output says: TUM's format (.tum), or KITTI's with the times beside it.
/// Throws OutputError.
ExitCode WritePoseFile(const ConvertRequest& request, const std::vector<StampedPose>& poses);

/// True for a file that is named as a trajectory is: .tum, .txt or .csv.
bool IsTrajectoryFile(const std::filesystem::path& path);

/// A trajectory of any format that has stamps, in another. Throws InputError and OutputError.
ExitCode ConvertTrajectory(const ConvertRequest& request);

}  // namespace trajlo
