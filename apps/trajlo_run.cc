// SPDX-License-Identifier: MIT
// LiDAR odometry: a recording goes in, a trajectory and a map come out. See --help.
#include <gflags/gflags.h>

#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/config_names.h"
#include "apps/inputs.h"
#include "apps/interrupt.h"
#include "apps/load_config.h"
#include "apps/require_extrinsics.h"
#include "apps/run/run_job.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/io/number_text.h"
#include "core/options/did_you_mean.h"

DEFINE_string(input, "", "the recording: bag, capture or folder of scans; several with commas");
DEFINE_string(output, "", "the folder to write");
DEFINE_string(config, "", "names or YAML files, separated by commas; later ones win");
DEFINE_string(set, "", "options to change: key=value, separated by commas");
DEFINE_string(solver, "", "ceres or gauss_newton");
DEFINE_int32(threads, -1, "0 for all cores; the result does not depend on it");
DEFINE_double(rate, 0.0, "poses per second in trajectory.tum; 0 writes the control poses");
DEFINE_string(at, "", "one pose per scan: scan-end or scan-mid");
DEFINE_string(inspect, "", "windows whose factor graphs are written: 431,500-509");
DEFINE_bool(covariance, false, "write covariance.csv");
DEFINE_bool(view, true, "write view.ply, a thinned choice of the scans for the 3-D view");
DEFINE_bool(overwrite, false, "replace an earlier result in the output folder");
DEFINE_bool(quiet, false, "print warnings and errors only");
DEFINE_bool(show_config, false, "print the configuration, every option explained, and stop");
DEFINE_bool(show_expert_config, false,
            "print the options for those who study the estimator, and stop");
DEFINE_bool(list_configs, false, "list the configurations that --config knows by name, and stop");

namespace {

using trajlo::ExitCode;
using trajlo::UsageError;

constexpr char kHelp[] = R"(LiDAR odometry: a recording goes in, a trajectory and a map come out.

  trajlo_run flight.bag -o result
      reads a ROS 1 bag, a ROS 2 bag (.db3, .mcap or its folder), a capture of Velodyne or Ouster
      packets (.pcap), a folder of bags that follow each other, or a folder of scans (.pcd, .ply,
      .bin), and writes
        result/trajectory.tum   poses of the body: time x y z qx qy qz qw
        result/map.ply          the map at the end
        result/view.ply         some points of some scans, for the 3-D view that draw_run.py makes
        result/windows.csv      what happened in every window
        result/flags.csv        for every pose, whether it can be trusted
        result/rig.yaml         poses and clocks of several LiDARs, as found
        result/config.yaml      all options of the run
        result/run.json         counts, times, warnings, and how the run ended
  trajlo_run flight.bag -o result --config ouster
      settings by name (--list_configs lists the names) or from a YAML file of your own;
      --config ouster,indoor,mine.yaml takes several, and later ones win
  trajlo_run flight.bag -o result --set window.segments=3 --set map.voxel_size_m=0.4
      options for this run alone
  trajlo_run flight.bag -o result --set input.topics=/os1_cloud_node1/points
      one of several topics; trajlo_info flight.bag lists them and prints the command to use
  trajlo_run kitti/sequences/00 -o result --config kitti
      motion-corrected scans without point times
  trajlo_run front rear -o result --config rig.yaml
      several LiDARs; sensor.T_body_lidar in rig.yaml has the pose of each on the body
  trajlo_run flight.bag -o again --inspect 431
      the factor graph of window 431 of windows.csv: every residual, weight, prior and H, in
      again/windows/000431.json and its points in 000431.ply; scripts/draw_window.py draws it
  trajlo_run --show_config
      every option with its value and its meaning (with --config and --set: as these set it)

Flags:
  -o, --output=FOLDER           where the result goes
  -c, --config=NAMES            names of configurations, and YAML files
  --set=KEY=VALUE               change options; may be repeated
  --input=RECORDING             the same as the argument; several are separated by commas
  --solver=ceres|gauss_newton   how a window is solved (solver.kind)
  --threads=N                   0 for all cores; the result does not depend on it (one more thread
                                reads the recording; N decompress bz2 in a ROS 1 bag, if N > 1)
  --rate=HZ                     trajectory.tum at even times
  --at=scan-end|scan-mid        trajectory.tum with one pose per scan
  --covariance                  write covariance.csv: a 6x6 covariance for every control pose
  --inspect=N,FIRST-LAST        write the factor graphs of these windows, counted as in windows.csv
  --noview                      write no view.ply
  --overwrite                   replace an earlier result
  --quiet                       print warnings and errors only
  --list_configs                the names that --config knows, a sentence each
  --show_config, --show_expert_config   the options for users, and those for research
  -h, --help, --version         --version also names the libraries in use
  --completion=bash|zsh         print the shell's completion: source <(trajlo_run --completion=bash)

Flags may stand anywhere. A value may follow after a space in place of the `=`.

Exit codes: 0 ok, 1 wrong usage or configuration, 2 input unreadable, 3 part of the input is
damaged or missing, or poses may be far off (the message says why), 4 the estimator got lost, 5
output not writable, 6 out of memory or a defect of the program, 130 interrupted. After 3, 4 and
130, the result so far is written.
)";

trajlo::RunConfig ConfigFromFlags() {
  const trajlo::RunConfig config = trajlo::LoadConfig(
      FLAGS_config, FLAGS_set, {{"solver", "solver.kind"}, {"threads", "threads"}});
  trajlo::CheckConfig(config);
  return config;
}

trajlo::SamplingOptions SamplingFromFlags() {
  if (FLAGS_rate != 0.0 && !FLAGS_at.empty()) {
    throw UsageError("--rate and --at exclude each other");
  }
  if (!(FLAGS_rate >= 0.0 && FLAGS_rate <= 1e6)) {
    throw UsageError("--rate: must be between 0 and 1e6 Hz");
  }
  if (FLAGS_rate > 0.0) return {trajlo::SampleAt::kRate, FLAGS_rate};
  if (FLAGS_at == "scan-end") return {trajlo::SampleAt::kScanEnd, 0.0};
  if (FLAGS_at == "scan-mid") return {trajlo::SampleAt::kScanMid, 0.0};
  if (!FLAGS_at.empty()) {
    throw UsageError("--at: must be scan-end or scan-mid, found '" + FLAGS_at + "'" +
                     trajlo::DidYouMean(FLAGS_at, {"scan-end", "scan-mid"}));
  }
  return {};
}

/// "431,500-509"
std::set<std::int64_t> WindowsFromFlags() {
  // Each is a file of a megabyte: more than that is a slip.
  constexpr std::int64_t kMost = 10'000;
  std::set<std::int64_t> windows;
  for (const std::string& part : trajlo::SplitAtCommas(FLAGS_inspect)) {
    const std::size_t dash = part.find('-');
    std::int64_t first = 0, last = 0;
    if (!trajlo::ParseNumber(part.substr(0, dash), &first) ||
        !trajlo::ParseNumber(dash == std::string::npos ? part : part.substr(dash + 1), &last) ||
        first < 0 || last < first || last - first >= kMost) {
      throw UsageError(
          "--inspect: must be numbers of windows, or ranges such as 500-509 of at most " +
          std::to_string(kMost) + ", found '" + part + "'");
    }
    for (std::int64_t index = first; index <= last; ++index) windows.insert(index);
  }
  return windows;
}

trajlo::RunRequest RequestFromFlags(const trajlo::CommandLine& line) {
  trajlo::RunRequest request;
  request.command_line = line.words;
  request.config = ConfigFromFlags();
  request.sampling = SamplingFromFlags();
  request.inputs = trajlo::InputsOf(line, FLAGS_input);
  if (FLAGS_output.empty()) throw UsageError("--output is missing");
  trajlo::RequireExtrinsics(request.inputs, request.config);
  trajlo::RequireOptionsOfEachLidar(request.inputs, request.config.input);
  request.output = FLAGS_output;
  request.covariance = FLAGS_covariance;
  request.view = FLAGS_view;
  request.inspected = WindowsFromFlags();
  request.overwrite = FLAGS_overwrite;
  request.quiet = FLAGS_quiet;
  return request;
}

void ListConfigs() {
  for (const trajlo::NamedConfig& config : trajlo::NamedConfigs()) {
    std::printf("%-22s %s\n", config.name.c_str(), config.sentence.c_str());
  }
}

void ShowConfig() {
  const auto options = !FLAGS_show_expert_config ? trajlo::DumpedOptions::kForUsers
                       : !FLAGS_show_config      ? trajlo::DumpedOptions::kForExperts
                                                 : trajlo::DumpedOptions::kAll;
  std::fputs(trajlo::DumpConfig(ConfigFromFlags(), options).c_str(), stdout);
}

ExitCode Run(const trajlo::CommandLine& line) {
  if (FLAGS_list_configs || FLAGS_show_config || FLAGS_show_expert_config) {
    trajlo::RequireNoArguments(line);
    if (FLAGS_list_configs) ListConfigs();
    if (FLAGS_show_config || FLAGS_show_expert_config) ShowConfig();
    return ExitCode::kOk;
  }
  return trajlo::RunJob(RequestFromFlags(line), trajlo::HandleInterrupts());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "solver") return {"ceres", "gauss_newton"};
  if (flag == "at") return {"scan-end", "scan-mid"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_run", kHelp, Run, Values, true}, argc, argv);
}
