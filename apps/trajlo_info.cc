// SPDX-License-Identifier: MIT
// What a recording contains, and the command to run on it. See --help.
#include <gflags/gflags.h>

#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/info/info_job.h"
#include "apps/interrupt.h"
#include "apps/usage_error.h"
#include "core/config/config.h"
#include "core/io/recording/open_recording.h"

DEFINE_string(input, "", "the recording; in place of the arguments");
DEFINE_bool(json, false, "print JSON");
DEFINE_bool(quick, false, "read the first messages only");
DEFINE_bool(quiet, false, "no progress");
DEFINE_string(velodyne_model, "auto", "of packets that do not name it");

namespace {

using trajlo::ExitCode;

constexpr char kHelp[] = R"(What a recording contains, and the command to run on it.

  trajlo_info recording.bag
      topics, fields, rates, what the point times mean and how that is known, gaps and other faults
      of the stamps, ranges, rings, how the sweeps of several LiDARs lie relative to each other, and
      the trajlo_run command to use
  trajlo_info recording.bag --quick
      reads the first messages only
  trajlo_info a.bag b.mcap capture.pcap folder_of_scans
      ROS 1 bags, ROS 2 bags (.db3, .mcap or the folder), packet captures, folders of scans
  trajlo_info recording.bag --json
      the same for programs

Flags:
  --velodyne_model=VLP-16   for a capture whose packets do not name the model (old firmware): VLP-16,
                            Puck-Hi-Res, HDL-32E or VLP-32C
  --input=RECORDING         the same as the argument
  --json, --quick
  --quiet                   show no progress
  -h, --help, --version

Exit codes: 0 ok, 1 wrong usage, 2 a recording is unreadable, or has clouds without a point, 3 a
recording is damaged (what can be read is shown), 5 output not writable, 6 out of memory or a defect
of the program, 130 interrupted.
)";

ExitCode Info(const trajlo::CommandLine& line) {
  trajlo::InfoRequest request;
  request.recordings = line.arguments;
  if (!FLAGS_input.empty()) {
    trajlo::RequireNoArguments(line);
    request.recordings = trajlo::InputPaths(FLAGS_input);
  }
  request.program_folder = line.words.front().substr(0, line.words.front().rfind('/') + 1);
  request.json = FLAGS_json;
  request.quick = FLAGS_quick;
  request.quiet = FLAGS_quiet;
  trajlo::RunConfig config;
  trajlo::ApplyOverrides("input.velodyne_model=" + FLAGS_velodyne_model, &config,
                         "--velodyne_model");
  request.velodyne_model = config.input.velodyne_model;
  if (request.recordings.empty()) {
    throw trajlo::UsageError("no recording given: trajlo_info RECORDING");
  }
  return trajlo::InfoJob(request, trajlo::HandleInterrupts());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "velodyne_model") return {"auto", "VLP-16", "Puck-Hi-Res", "HDL-32E", "VLP-32C"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_info", kHelp, Info, Values, true}, argc, argv);
}
