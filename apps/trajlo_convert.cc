// SPDX-License-Identifier: MIT
// Recordings of any kind as bags or folders of scans, excerpts, and the poses in bags. See --help.
#include <gflags/gflags.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>

#include "apps/convert/convert_job.h"
#include "apps/run/interrupt.h"
#include "core/config/config.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/report/versions.h"

DEFINE_string(topics, "", "of a bag, separated by commas; empty for all");
DEFINE_double(start_s, 0.0, "skip so much of the recording");
DEFINE_double(duration_s, 0.0, "the length of the excerpt; 0 for all");
DEFINE_string(layout, "", "of the points in a bag: ouster, velodyne or livox");
DEFINE_string(compression, "none", "of a bag: none, lz4 or bz2");
DEFINE_string(poses, "", "the topic whose poses are written");
DEFINE_string(config, "", "YAML files, separated by commas, of which input.* counts");
DEFINE_string(set, "", "options of input.*: key=value, separated by commas");
DEFINE_bool(overwrite, false, "replace an earlier result");
DEFINE_bool(quiet, false, "print warnings and errors only");

namespace {

using trajlo::ConfigError;
using trajlo::ExitCode;

constexpr char kHelp[] =
    R"(Recordings of any kind as ROS 1 bags or folders of scans, and the poses in bags.

  trajlo_convert recording.bag part.bag --start_s=60 --duration_s=30
      an excerpt; messages of all topics are copied byte by byte (ROS 1 bags), by when they were
      recorded
  trajlo_convert broken.bag mended.bag --compression=lz4
      everything that can be read, with an index again
  trajlo_convert recording.mcap recording.bag --layout=ouster
      the points of ROS 2 bags, captures (.pcap) and folders of scans as a ROS 1 bag; a layout given
      for a ROS 1 bag converts its points instead of copying its messages
  trajlo_convert recording.bag scans
      scans/scans/*.pcd and scans/timestamps.txt (several LiDARs: scans/lidar0/..., scans/lidar1/...)
  trajlo_convert square.bag truth.tum --poses=/leica/pose/relative
      PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped or Odometry as TUM
      (ROS 1 and ROS 2)

Flags:
  --topics=A,B                  of a bag; empty takes all
  --start_s=S --duration_s=S    from the first message (of its kind) on
  --layout=ouster|velodyne|livox
  --compression=none|lz4|bz2    of the bag
  --set=input.time_unit=us, --config=FILE   how point times are meant, as for trajlo_run
  --overwrite, --quiet, --version

Points keep their positions and times: to the ns in the layouts of Ouster and Livox and in PCD (field
t, uint32, ns), to 4 ns in Velodyne's (float32, s). Livox's has whole intensities from 0 to 255. Stamps
become those of the sweeps' starts. Rings and other fields are kept only where messages are copied.

Exit codes: 0 ok, 1 wrong usage, 2 input unreadable, 3 a part of the input is damaged (the rest is
written), 5 output not writable, 130 interrupted (what was read is written).
)";

bool Has(int argc, char** argv, std::initializer_list<const char*> flags) {
  for (int i = 1; i < argc; ++i) {
    for (const char* flag : flags) {
      if (std::strcmp(argv[i], flag) == 0) return true;
    }
  }
  return false;
}

std::vector<std::string> Split(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ',');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

trajlo::RecordingOptions RecordingFromFlags() {
  trajlo::RunConfig config;
  for (const std::string& file : Split(FLAGS_config)) trajlo::LoadConfigFile(file, &config);
  trajlo::ApplyOverrides(FLAGS_set, &config);
  trajlo::CheckConfig(config);
  if (!(FLAGS_start_s >= 0.0 && FLAGS_start_s <= 1e9)) {
    throw ConfigError("--start_s: must be between 0 and 1e9 s");
  }
  if (!(FLAGS_duration_s >= 0.0 && FLAGS_duration_s <= 1e9)) {
    throw ConfigError("--duration_s: must be between 0 and 1e9 s");
  }
  if (!FLAGS_topics.empty()) config.input.topics = Split(FLAGS_topics);
  if (FLAGS_start_s > 0.0) config.input.start_s = FLAGS_start_s;
  if (FLAGS_duration_s > 0.0) config.input.duration_s = FLAGS_duration_s;
  return config.input;
}

trajlo::ConvertRequest RequestFromFlags(int argc, char** argv) {
  if (argc != 3) throw ConfigError("an input and an output are needed");
  trajlo::ConvertRequest request;
  request.input = argv[1];
  request.output = argv[2];
  request.recording = RecordingFromFlags();
  request.poses = FLAGS_poses;
  request.overwrite = FLAGS_overwrite;
  request.quiet = FLAGS_quiet;
  const auto compression = trajlo::ParseBagCompression(FLAGS_compression);
  if (!compression) {
    throw ConfigError("--compression: must be none, lz4 or bz2, found '" + FLAGS_compression + "'");
  }
  request.compression = *compression;
  if (!FLAGS_layout.empty()) {
    request.layout = trajlo::ParseCloudLayout(FLAGS_layout);
    if (!request.layout) {
      throw ConfigError("--layout: must be ouster, velodyne or livox, found '" + FLAGS_layout +
                        "'");
    }
  }
  const bool for_bags = request.layout || FLAGS_compression != "none";
  if (for_bags && !request.WritesBag()) {
    throw ConfigError("--layout and --compression are for bags: the output must end in .bag");
  }
  std::error_code error;
  if (std::filesystem::equivalent(request.input, request.output, error)) {
    throw ConfigError("input and output are the same");
  }
  for (const char* other : {".mcap", ".db3", ".pcap", ".pcd", ".bin", ".ply"}) {
    if (request.poses.empty() && request.output.extension() == other) {
      throw ConfigError("the output is a .bag or a folder of scans, not a " + std::string(other));
    }
  }
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  // Ahead of gflags, whose own help lists the flags of every library that is linked.
  if (Has(argc, argv, {"--help", "-help", "-h"})) {
    std::fputs(kHelp, stdout);
    return static_cast<int>(ExitCode::kOk);
  }
  if (Has(argc, argv, {"--version", "-version"})) {
    const trajlo::Versions versions = trajlo::GetVersions();
    std::printf("trajlo_convert %s (commit %s)\n", versions.trajlo.c_str(), versions.git.c_str());
    return static_cast<int>(ExitCode::kOk);
  }
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, true);
  trajlo::ConvertRequest request;
  try {
    request = RequestFromFlags(argc, argv);
  } catch (const ConfigError& error) {
    std::fprintf(stderr, "trajlo_convert: %s\n(trajlo_convert --help shows examples)\n",
                 error.what());
    return static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(trajlo::ConvertJob(request, trajlo::HandleInterrupts()));
}
