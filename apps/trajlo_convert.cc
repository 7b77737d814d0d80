// SPDX-License-Identifier: MIT
// Recordings of any kind as bags or folders of scans, excerpts, the poses in bags, and results of
// trajlo_run for other tools. See --help.
#include <gflags/gflags.h>

#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/convert/convert_job.h"
#include "apps/convert/pose_files.h"
#include "apps/interrupt.h"
#include "apps/load_config.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"
#include "core/export/run_result.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/io/errors.h"
#include "core/io/recording/open_recording.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"

DEFINE_string(input, "", "the recording; in place of the first argument");
DEFINE_string(output, "", "the bag, folder or file to write; in place of the last argument");
DEFINE_string(topics, "", "of a bag, separated by commas; empty for all");
DEFINE_double(start_s, 0.0, "skip this much of the recording");
DEFINE_double(duration_s, 0.0, "the length of the excerpt; 0 for all");
DEFINE_string(layout, "", "of the points in a bag: ouster, velodyne or livox");
DEFINE_string(compression, "", "of a bag: none, lz4 or bz2; of MCAP: zstd, lz4 or none");
DEFINE_string(poses, "", "the topic whose poses are written");
DEFINE_string(config, "", "YAML files, separated by commas, of which input.* counts");
DEFINE_string(set, "", "options of input.*: key=value, separated by commas");
DEFINE_string(recording, "", "where the recording of a result is now");
DEFINE_bool(scans, true, "deskewed scans in the bag of a result");
DEFINE_bool(map, true, "the map in the bag of a result");
DEFINE_double(voxel_m, 0.0, "of the map of a result; 0 for the spacing of the run's map");
DEFINE_string(color, "height", "of the map of a result: height, intensity or time");
DEFINE_string(frame, "body", "of deskewed scans: body or world");
DEFINE_string(scan_format, "pcd", "of a folder of deskewed scans: pcd or ply");
DEFINE_bool(keep_lost, false, "keep poses from where the estimator got lost on");
DEFINE_bool(overwrite, false, "replace an earlier result");
DEFINE_bool(quiet, false, "print warnings and errors only");

namespace {

using trajlo::ExitCode;
using trajlo::UsageError;

constexpr char kHelp[] =
    R"(Converts results of trajlo_run for other tools, and recordings to other formats.

  trajlo_convert result result.mcap
      a result for Foxglove and RViz (ros2 bag play): /tf, /odometry, /path, /map, and the deskewed
      scans as /points_deskewed. Also .db3 and .bag. --noscans or --nomap leave these out; without
      both, the recording is not read
  trajlo_convert result map.ply
      the map of the whole run with intensity, normals and colours (.pcd, too):
      --voxel_m=M, --color=height|intensity|time
  trajlo_convert result deskewed
      deskewed/scans/*.pcd, one per scan (--scan_format=ply), in the frame of the body at the scan's
      last point (--frame=world), with timestamps.txt, poses.txt (KITTI) and poses.tum
  trajlo_convert result poses.txt
      the poses in KITTI's format, and poses_times.txt; with .tum in TUM's

  trajlo_convert truth.csv truth.tum
      a trajectory in another format: from TUM's or EuRoC's to TUM's, or KITTI's (.txt)

  trajlo_convert recording.bag part.bag --start_s=60 --duration_s=30
      an excerpt by time of recording; messages of all topics are copied byte by byte
  trajlo_convert broken.bag repaired.bag --compression=lz4
      everything that can be read, with a new index
  trajlo_convert recording.bag recording.mcap
      a bag of one kind (.bag, .mcap, .db3) as another: messages of all topics with all fields. From
      ROS 2 to ROS 1 only clouds, PoseStamped, Odometry, Path and TF; the rest is left out and named
      (exit code 3, unless --topics names what is wanted)
  trajlo_convert recording.pcap recording.mcap --layout=ouster
      the points of captures (.pcap) and folders of scans as a bag; a layout given for a bag
      converts its points instead of copying its messages
  trajlo_convert recording.bag scans
      scans/scans/*.pcd and scans/timestamps.txt; several LiDARs: scans/lidar0/..., scans/lidar1/...
      with record_times.txt beside timestamps.txt, by which trajlo_run merges them
  trajlo_convert square.bag truth.tum --poses=/leica/pose/relative
      the poses of a topic (PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped
      or Odometry, ROS 1 and ROS 2) in TUM's format

Flags of results:
  --recording=PATH              where the recording is now, if it was moved
  --keep_lost                   keep the poses after the estimator got lost
  --noscans, --nomap            no deskewed scans, no map in a bag
  --voxel_m=M                   one point of the map per voxel of that size; 0: as in the run
  --color=height|intensity|time   of the map
  --frame=body|world            of deskewed scans (body)
  --scan_format=pcd|ply         of a folder of deskewed scans
Flags of recordings:
  --topics=A,B                  of a bag; by default all
  --poses=TOPIC                 write the poses of that topic, in TUM's format
  --start_s=S --duration_s=S    from the first message (of its kind) on
  --layout=ouster|velodyne|livox
  --set=input.time_unit=us, --config=NAME   how to read point times, as for trajlo_run
Flags of both:
  --compression=NAME            of .bag none, lz4 or bz2; of .mcap zstd, lz4 or none
  -o, --output=OUTPUT           the same as the last argument
  --input=INPUT                 the same as the first argument
  --overwrite                   replace an earlier result
  --quiet                       print warnings and errors only
  -h, --help, --version

Points of recordings keep their positions and times: to the ns in the layouts of Ouster and Livox and
in PCD (field t, uint32, ns), to 4 ns in Velodyne's (float32, s). Livox's has whole intensities from 0
to 255. Stamps become those of the sweeps' starts; scans keep their order, whatever the stamps. Rings
and other fields are kept only where messages are copied.
Points of results have no times: they are deskewed. Left out, and counted, are those outside the
trajectory and within pauses; so are poses that are not to be trusted.

Exit codes: 0 ok, 1 wrong usage, 2 input unreadable, 3 a part of the input is damaged, a topic is
left out, or the recording is not what it was (the rest is written), 5 output not writable, 6 out of
memory or a defect of the program, 130 interrupted (what was read is written).
)";

trajlo::RecordingOptions RecordingFromFlags() {
  const trajlo::RunConfig config = trajlo::LoadConfig(FLAGS_config, FLAGS_set,
                                                      {{"topics", "input.topics"},
                                                       {"start_s", "input.start_s"},
                                                       {"duration_s", "input.duration_s"}});
  trajlo::CheckConfig(config);
  return config.input;
}

trajlo::ExportOptions ExportsFromFlags() {
  trajlo::ExportOptions exports;
  exports.recording = FLAGS_recording;
  exports.scans = FLAGS_scans;
  exports.map = FLAGS_map;
  exports.keep_lost = FLAGS_keep_lost;
  if (!(FLAGS_voxel_m == 0.0 || (FLAGS_voxel_m >= 0.001 && FLAGS_voxel_m <= 100.0))) {
    throw UsageError("--voxel_m: must be between 0.001 and 100 m, or 0");
  }
  exports.voxel_m = FLAGS_voxel_m;
  const auto color = trajlo::ParseColorBy(FLAGS_color);
  if (!color) {
    throw UsageError("--color: must be height, intensity or time, found '" + FLAGS_color + "'" +
                     trajlo::DidYouMean(FLAGS_color, {"height", "intensity", "time"}));
  }
  exports.color = *color;
  if (FLAGS_frame != "body" && FLAGS_frame != "world") {
    throw UsageError("--frame: must be body or world, found '" + FLAGS_frame + "'" +
                     trajlo::DidYouMean(FLAGS_frame, {"body", "world"}));
  }
  exports.frame = FLAGS_frame == "body" ? trajlo::PointFrame::kBody : trajlo::PointFrame::kWorld;
  if (FLAGS_scan_format != "pcd" && FLAGS_scan_format != "ply") {
    throw UsageError("--scan_format: must be pcd or ply, found '" + FLAGS_scan_format + "'");
  }
  exports.scan_files = "." + FLAGS_scan_format;
  return exports;
}

void CheckOutput(const trajlo::ConvertRequest& request) {
  std::error_code error;
  if (std::filesystem::equivalent(request.input, request.output, error)) {
    throw UsageError("input and output are the same");
  }
  const bool for_bags = request.layout || !request.compression.empty();
  if (for_bags && !request.WritesBag()) {
    throw UsageError(
        "--layout and --compression are for bags: the output must end in .bag, .mcap or .db3");
  }
  if (for_bags && !trajlo::IsBagCompression(request.output, request.compression)) {
    throw UsageError("--compression: must be " + trajlo::BagCompressions(request.output) +
                     " for such an output, found '" + request.compression + "'");
  }
}

/// The name says what is written: a misspelt ending must not make a folder.
void CheckEnding(const std::filesystem::path& output, const std::vector<std::string>& endings) {
  const std::string ending = output.extension().string();
  if (ending.empty()) return;
  std::string all;
  for (const std::string& known : endings) {
    if (ending == "." + known) return;
    all += (all.empty() ? "." : known == endings.back() ? " or ." : ", .") + known;
  }
  std::string word = ending.substr(1);
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  throw UsageError("the output must end in " + all + ", not in " + ending +
                   trajlo::Suggestion(trajlo::NearestKey(word, endings), ".", "") +
                   " (the name of a folder, if it has a dot, must end in '/')");
}

/// Maps and poses are asked of recordings that have none yet.
void RefuseWhatResultsGive(const std::filesystem::path& output) {
  const std::string ending = output.extension().string();
  if (ending == ".ply" || ending == ".pcd") {
    throw UsageError(
        "a map comes from a result, and the input is a recording: trajlo_run RECORDING "
        "-o RESULT, then trajlo_convert RESULT " +
        output.string());
  }
  if (ending == ".tum" || ending == ".txt") {
    throw UsageError(
        "poses come from a result (trajlo_run RECORDING -o RESULT, then trajlo_convert "
        "RESULT " +
        output.string() + "), or from a topic of a bag: --poses=TOPIC");
  }
}

/// Flags that a result has no use for are mistakes.
void CheckResultOutput(const trajlo::ConvertRequest& request) {
  const bool is_excerpt = FLAGS_start_s > 0.0 || FLAGS_duration_s > 0.0;
  if (is_excerpt || request.layout || !FLAGS_topics.empty() || !FLAGS_poses.empty() ||
      !FLAGS_config.empty() || !FLAGS_set.empty()) {
    throw UsageError(
        "--start_s, --duration_s, --layout, --topics, --poses, --config and --set are for "
        "recordings; " +
        request.input + " is a result of trajlo_run");
  }
  CheckEnding(request.output, {"mcap", "db3", "bag", "ply", "pcd", "txt", "tum"});
}

/// So that a path that is wrong is no question of what may become of it.
void CheckInput(const std::string& input) {
  std::error_code error;
  if (std::filesystem::exists(input, error)) return;
  for (const std::string& path : trajlo::InputPaths(input)) {
    if (std::filesystem::exists(path, error)) continue;
    throw trajlo::InputError(path, "there is no such file or folder", "Check the path.");
  }
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
  request.compression = FLAGS_compression;
  if (!FLAGS_layout.empty()) {
    request.layout = trajlo::ParseCloudLayout(FLAGS_layout);
    if (!request.layout) {
      throw UsageError("--layout: must be ouster, velodyne or livox, found '" + FLAGS_layout + "'" +
                       trajlo::DidYouMean(FLAGS_layout, {"ouster", "velodyne", "livox"}));
    }
  }
  request.exports = ExportsFromFlags();
  CheckInput(request.input);
  CheckOutput(request);
  if (trajlo::IsRunResult(request.input)) {
    CheckResultOutput(request);
  } else if (trajlo::IsTrajectoryFile(request.input)) {
    CheckEnding(request.output, {"tum", "txt"});
  } else {
    if (request.poses.empty()) RefuseWhatResultsGive(request.output);
    CheckEnding(request.output, request.poses.empty()
                                    ? std::vector<std::string>{"mcap", "db3", "bag"}
                                    : std::vector<std::string>{"tum", "txt"});
  }
  return request;
}

ExitCode Convert(const trajlo::CommandLine& line) {
  return trajlo::ConvertJob(RequestFromFlags(line.arguments), trajlo::HandleInterrupts());
}

std::vector<std::string> Values(const std::string& flag) {
  if (flag == "layout") return {"ouster", "velodyne", "livox"};
  if (flag == "compression") return {"none", "lz4", "bz2", "zstd"};
  if (flag == "color") return {"height", "intensity", "time"};
  if (flag == "frame") return {"body", "world"};
  if (flag == "scan_format") return {"pcd", "ply"};
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  return trajlo::RunCommand({"trajlo_convert", kHelp, Convert, Values, true}, argc, argv);
}
