// SPDX-License-Identifier: MIT
// The library in thirty lines: minimal_odometry FOLDER prints the trajectory in TUM format.
#include <cstdio>
#include <exception>
#include <string>

#include "core/io/scan_folder.h"
#include "core/io/stamp_text.h"
#include "core/odometry/odometry.h"

int main(int argc, char** argv) try {
  const std::string argument = argc == 2 ? argv[1] : "";
  if (argument.empty() || argument[0] == '-') {
    const bool is_asked = argument == "--help" || argument == "-h";
    std::fputs(
        "usage: minimal_odometry FOLDER_OF_SCANS > trajectory.tum\n"
        "The library in thirty lines: the trajectory of scans (.pcd, .ply, .bin) in TUM's "
        "format.\n",
        is_asked ? stdout : stderr);
    return is_asked ? 0 : 1;
  }
  trajlo::OdometryOptions options;
  options.window.segments = 4;
  options.segmenter.interval_s = 0.03;

  trajlo::Odometry odometry(options);
  trajlo::ScanFolder recording(argv[1]);
  trajlo::LidarScan scan;
  while (recording.Next(&scan)) odometry.AddScan(scan);
  odometry.Finish();

  for (const trajlo::ControlPose& pose : odometry.trajectory().poses()) {
    const trajlo::SE3& T = pose.T_world_body;
    std::printf("%s %.6f %.6f %.6f %.9f %.9f %.9f %.9f\n", trajlo::FormatSeconds(pose.t_ns).c_str(),
                T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
