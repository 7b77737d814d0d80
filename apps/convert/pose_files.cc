// SPDX-License-Identifier: MIT
#include "apps/convert/pose_files.h"

#include <cstdio>
#include <string>
#include <system_error>

#include "apps/print_warnings.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_file.h"
#include "core/io/trajectory_writer.h"

namespace trajlo {

namespace fs = std::filesystem;

ExitCode WritePoseFile(const ConvertRequest& request, const std::vector<StampedPose>& poses) {
  if (request.output.extension() == ".tum") {
    TumWriter tum(request.output, request.WhatIfExists());
    for (const StampedPose& pose : poses) tum.Append(pose.t_ns, pose.T_world_body);
    tum.Flush();
    tum.Close();
  } else {
    // KITTI's format has no times: they stand beside it. Neither is begun if the other is in the
    // way.
    const fs::path times_path =
        request.output.parent_path() / (request.output.stem().string() + "_times.txt");
    AtomicFile times(times_path, request.WhatIfExists());
    KittiWriter kitti(request.output, request.WhatIfExists());
    for (const StampedPose& pose : poses) {
      kitti.Append(pose.T_world_body);
      times.Write(FormatSeconds(pose.t_ns) + "\n");
    }
    kitti.Flush();
    kitti.Close();
    times.Commit();
    if (!request.quiet) std::printf("times in %s\n", times_path.c_str());
  }
  if (!request.quiet) {
    std::printf("%s in %s\n", CountOf(poses.size(), "pose").c_str(), request.output.c_str());
  }
  return ExitCode::kOk;
}

bool IsTrajectoryFile(const fs::path& path) {
  std::error_code error;
  const fs::path extension = path.extension();
  return (extension == ".tum" || extension == ".txt" || extension == ".csv") &&
         fs::is_regular_file(path, error);
}

ExitCode ConvertTrajectory(const ConvertRequest& request) {
  std::vector<std::string> warnings;
  const TrajectoryFile file = ReadTrajectory(request.input, TrajectoryFormat::kAuto, &warnings);
  if (!file.has_rotations) {
    warnings.push_back(request.input +
                       ": has positions without rotations; the identity is written for each, and "
                       "angles mean nothing");
  }
  PrintWarnings("trajlo_convert", warnings);
  if (file.t_ns.empty()) {
    throw InputError(request.input, "has poses without stamps (KITTI's format)",
                     "trajlo_evaluate takes such a file as it is, with --times=FILE.");
  }
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < file.t_ns.size(); ++i) {
    const Eigen::Affine3d& T = file.T_world_body[i];
    poses.push_back({file.t_ns[i], SE3(Eigen::Quaterniond(T.linear()), T.translation())});
  }
  return WritePoseFile(request, poses);
}

}  // namespace trajlo
