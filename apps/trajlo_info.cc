// SPDX-License-Identifier: MIT
// What a recording holds, and how to run on it. See --help.
#include <gflags/gflags.h>

#include "apps/command.h"
#include "apps/info/info_job.h"
#include "apps/interrupt.h"
#include "apps/usage_error.h"
#include "core/config/config.h"

DEFINE_bool(json, false, "print JSON");
DEFINE_bool(quick, false, "read the first messages only");
DEFINE_bool(quiet, false, "no progress");
DEFINE_string(velodyne_model, "auto", "of packets that do not name it");

namespace {

using trajlo::ExitCode;

constexpr char kHelp[] = R"(What a recording holds, and how to run on it.

  trajlo_info recording.bag
      topics, fields, rates, what the point times mean and by which evidence, gaps and other faults
      of the stamps, ranges, rings, how the LiDARs' sweeps lie to each other, and the trajlo_run
      line to use
  trajlo_info recording.bag --quick
      the first messages only
  trajlo_info a.bag b.mcap capture.pcap folder_of_scans
      ROS 1 bags, ROS 2 bags (.db3, .mcap, or the folder), packet captures, folders of scans
  trajlo_info recording.bag --json
      the same for programs

More flags:
  --velodyne_model=VLP-16   of a capture whose packets do not name it (old firmware); Puck-Hi-Res,
                            HDL-32E, VLP-32C
  --quiet                   no progress
  --version

Exit codes: 0 ok, 1 wrong usage, 2 a recording is unreadable, 3 a recording is damaged (what can be
read is shown), 5 output not writable, 130 interrupted.
)";

ExitCode Info(const trajlo::CommandLine& line) {
  trajlo::InfoRequest request;
  request.recordings = line.arguments;
  request.json = FLAGS_json;
  request.quick = FLAGS_quick;
  request.quiet = FLAGS_quiet;
  trajlo::RunConfig config;
  trajlo::ApplyOverrides("input.velodyne_model=" + FLAGS_velodyne_model, &config,
                         "--velodyne_model");
  request.velodyne_model = config.input.velodyne_model;
  if (request.recordings.empty()) throw trajlo::UsageError("name a recording");
  return trajlo::InfoJob(request, trajlo::HandleInterrupts());
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_info", kHelp, Info}, argc, argv);
}
