// SPDX-License-Identifier: MIT
// Recordings of any kind as bags or folders of scans, excerpts, and the poses in bags. See --help.
#include <gflags/gflags.h>

#include <filesystem>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/convert/convert_job.h"
#include "apps/interrupt.h"
#include "apps/load_config.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/io/conversion/scan_bag_writer.h"

DEFINE_string(input, "", "the recording; in place of the first argument");
DEFINE_string(output, "", "the bag, folder or file to write; in place of the last argument");
DEFINE_string(topics, "", "of a bag, separated by commas; empty for all");
DEFINE_double(start_s, 0.0, "skip this much of the recording");
DEFINE_double(duration_s, 0.0, "the length of the excerpt; 0 for all");
DEFINE_string(layout, "", "of the points in a bag: ouster, velodyne or livox");
DEFINE_string(compression, "none", "of a bag: none, lz4 or bz2");
DEFINE_string(poses, "", "the topic whose poses are written");
DEFINE_string(config, "", "YAML files, separated by commas, of which input.* counts");
DEFINE_string(set, "", "options of input.*: key=value, separated by commas");
DEFINE_bool(overwrite, false, "replace an earlier result");
DEFINE_bool(quiet, false, "print warnings and errors only");

namespace {

using trajlo::ExitCode;
using trajlo::UsageError;

constexpr char kHelp[] =
    R"(Recordings of any kind as ROS 1 bags or folders of scans, and the poses in bags.

  trajlo_convert recording.bag part.bag --start_s=60 --duration_s=30
      an excerpt; messages of all topics are copied byte by byte (ROS 1 bags), by when they were
      recorded
  trajlo_convert broken.bag repaired.bag --compression=lz4
      everything that can be read, with a new index
  trajlo_convert recording.mcap recording.bag --layout=ouster
      the points of ROS 2 bags, captures (.pcap) and folders of scans as a ROS 1 bag; a layout given
      for a ROS 1 bag converts its points instead of copying its messages
  trajlo_convert recording.bag scans
      scans/scans/*.pcd and scans/timestamps.txt; several LiDARs: scans/lidar0/..., scans/lidar1/...
      with record_times.txt beside timestamps.txt, by which trajlo_run merges them
  trajlo_convert square.bag truth.tum --poses=/leica/pose/relative
      PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped or Odometry as TUM
      (ROS 1 and ROS 2)

Flags:
  -o, --output=OUTPUT           the same as the last argument
  --input=INPUT                 the same as the first argument
  --topics=A,B                  of a bag; all of them if empty
  --start_s=S --duration_s=S    from the first message (of its kind) on
  --layout=ouster|velodyne|livox
  --compression=none|lz4|bz2    of the bag
  --poses=TOPIC                 write the poses of this topic
  --set=input.time_unit=us, --config=NAME   how point times are meant, as for trajlo_run
  --overwrite                   replace an earlier result
  --quiet                       print warnings and errors only
  -h, --help, --version

Points keep their positions and times: to 1 ns in the layouts of Ouster and Livox and in PCD (field t,
uint32, ns), to 4 ns in Velodyne's (float32, s). Livox's layout has whole intensities from 0 to 255.
Stamps become those of the starts of the sweeps; scans keep their order, whatever the stamps. Rings
and other fields are kept only where messages are copied.

Exit codes: 0 ok, 1 wrong usage, 2 input unreadable, 3 part of the input is damaged (the rest is
written), 5 output not writable, 6 out of memory or a defect of the program, 130 interrupted (what
was read is written).
)";

trajlo::RecordingOptions RecordingFromFlags() {
  trajlo::RunConfig config = trajlo::LoadConfig(FLAGS_config, FLAGS_set);
  trajlo::CheckConfig(config);
  if (!(FLAGS_start_s >= 0.0 && FLAGS_start_s <= 1e9)) {
    throw UsageError("--start_s: must be between 0 and 1e9 s");
  }
  if (!(FLAGS_duration_s >= 0.0 && FLAGS_duration_s <= 1e9)) {
    throw UsageError("--duration_s: must be between 0 and 1e9 s");
  }
  if (!FLAGS_topics.empty()) config.input.topics = trajlo::SplitAtCommas(FLAGS_topics);
  if (FLAGS_start_s > 0.0) config.input.start_s = FLAGS_start_s;
  if (FLAGS_duration_s > 0.0) config.input.duration_s = FLAGS_duration_s;
  return config.input;
}

/// Arguments and flags may be mixed: trajlo_convert in.bag -o out.bag.
trajlo::ConvertRequest RequestFromFlags(std::vector<std::string> arguments) {
  if (!FLAGS_input.empty()) arguments.insert(arguments.begin(), FLAGS_input);
  if (!FLAGS_output.empty()) arguments.push_back(FLAGS_output);
  if (arguments.size() != 2) {
    throw UsageError("an input and an output are needed: trajlo_convert INPUT OUTPUT");
  }
  trajlo::ConvertRequest request;
  request.input = arguments[0];
  request.output = arguments[1];
  request.recording = RecordingFromFlags();
  request.poses = FLAGS_poses;
  request.overwrite = FLAGS_overwrite;
  request.quiet = FLAGS_quiet;
  const auto compression = trajlo::ParseBagCompression(FLAGS_compression);
  if (!compression) {
    throw UsageError("--compression: must be none, lz4 or bz2, found '" + FLAGS_compression + "'");
  }
  request.compression = *compression;
  if (!FLAGS_layout.empty()) {
    request.layout = trajlo::ParseCloudLayout(FLAGS_layout);
    if (!request.layout) {
      throw UsageError("--layout: must be ouster, velodyne or livox, found '" + FLAGS_layout + "'");
    }
  }
  const bool for_bags = request.layout || FLAGS_compression != "none";
  if (for_bags && !request.WritesBag()) {
    throw UsageError("--layout and --compression are for bags: the output must end in .bag");
  }
  std::error_code error;
  if (std::filesystem::equivalent(request.input, request.output, error)) {
    throw UsageError("input and output are the same");
  }
  for (const char* other : {".mcap", ".db3", ".pcap", ".pcd", ".bin", ".ply"}) {
    if (request.poses.empty() && request.output.extension() == other) {
      throw UsageError("the output is a .bag or a folder of scans, not a " + std::string(other));
    }
  }
  return request;
}

ExitCode Convert(const trajlo::CommandLine& line) {
  return trajlo::ConvertJob(RequestFromFlags(line.arguments), trajlo::HandleInterrupts());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "layout") return {"ouster", "velodyne", "livox"};
  if (flag == "compression") return {"none", "lz4", "bz2"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_convert", kHelp, Convert, Values, true}, argc, argv);
}
