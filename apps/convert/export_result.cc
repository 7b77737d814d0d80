// SPDX-License-Identifier: MIT
#include "apps/convert/export_result.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/convert/pose_files.h"
#include "apps/convert/protect_input.h"
#include "apps/print_warnings.h"
#include "core/export/map_file.h"
#include "core/export/placed_scan_folder.h"
#include "core/export/replay.h"
#include "core/export/result_bag.h"
#include "core/export/run_result.h"
#include "core/export/surface_map.h"
#include "core/io/conversion/pcd_folder_writer.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/recording/open_recording.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_reader.h"
#include "core/report/progress_bar.h"
#include "core/report/result_folder.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

constexpr char kCommand[] = "trajlo_convert";
constexpr int kAllCores = 0;

/// Where the recording should be.
std::vector<std::string> InputsOf(const ConvertRequest& request, const RunResult& result) {
  return request.exports.recording.empty() ? result.inputs : InputPaths(request.exports.recording);
}

/// The same, where it is.
std::vector<std::string> RecordingOf(const ConvertRequest& request, const RunResult& result) {
  const std::vector<std::string> inputs = InputsOf(request, result);
  for (const std::string& input : inputs) {
    std::error_code error;
    if (fs::exists(input, error)) continue;
    throw InputError(input, "the recording of this result is not there",
                     "Name it with --recording.");
  }
  return inputs;
}

std::size_t LidarsOf(const std::vector<std::string>& inputs, const RunResult& result) {
  return std::max<std::size_t>(1, LidarNames(inputs, result.config.input).size());
}

/// Neither the result nor its recording is to be lost, whether or not points are wanted.
void ProtectResult(const ConvertRequest& request, const RunResult& result) {
  std::vector<fs::path> read = FilesOfRecording(InputsOf(request, result), result.config.input);
  const ResultFolder files(request.input);
  read.insert(read.end(), {files.trajectory(), files.summary(), files.windows(), files.config(),
                           files.rig(), files.covariance()});
  ProtectInput(read, request.output);
}

void WarnOfResult(const fs::path& folder, const RunResult& result) {
  const std::string shortcoming = RunShortcoming(folder);
  if (!shortcoming.empty() && !result.lost_at_ns) {
    std::fprintf(stderr, "trajlo_convert: warning: %s: trajlo_run reported: %s\n", folder.c_str(),
                 shortcoming.c_str());
  }
  if (!result.unknown_keys.empty()) {
    std::string keys;
    for (const std::string& key : result.unknown_keys) keys += (keys.empty() ? "" : ", ") + key;
    std::fprintf(stderr,
                 "trajlo_convert: another version of trajlo_run wrote this result: what its "
                 "config.yaml says of %s is not used\n",
                 keys.c_str());
  }
  if (result.poses_left_out > 0) {
    std::fprintf(stderr,
                 "trajlo_convert: the estimator got lost at %s s: %s left out from there on "
                 "(--keep_lost keeps them)\n",
                 FormatSeconds(*result.lost_at_ns).c_str(),
                 CountOf(result.poses_left_out, "pose is", "poses are").c_str());
  }
}

/// The recording read again, and what came of it.
class Replay {
 public:
  Replay(const ConvertRequest& request, const RunResult& result,
         const std::vector<std::string>& inputs)
      : request_(request),
        result_(result),
        recording_(OpenRecording(inputs, result.config.input, kAllCores)) {}

  void Run(const std::atomic<bool>& stop, const std::function<void(const PlacedScan&)>& visit) {
    ProgressBar progress(stderr, request_.quiet);
    counts_ = ReplayRecording(result_, recording_.get(), [&](const PlacedScan& scan) {
      visit(scan);
      ++scans_;
      progress.Update(recording_->report().scans_read, recording_->size());
      return !stop;
    });
    was_stopped_ = stop;
  }

  /// Says what was left out; throws InputError if that is everything.
  ExitCode Judge() const {
    const ReadReport& report = recording_->report();
    PrintWarnings(kCommand, report.warnings);
    if (!result_.has_control_poses) {
      std::fprintf(stderr,
                   "trajlo_convert: trajectory.tum has poses at chosen times (--rate, --at): "
                   "points between them are placed less exactly than by the control poses\n");
    }
    if (counts_.placed == 0) {
      throw InputError(request_.input,
                       "none of the " + std::to_string(counts_.Received()) +
                           " points of the recording lies within its trajectory",
                       "Is this the recording that was run? --recording names another.");
    }
    if (counts_.outside + counts_.in_pause > 0) {
      std::fprintf(stderr,
                   "trajlo_convert: %s left out: %zu before or after the trajectory, "
                   "%zu within pauses\n",
                   CountOf(counts_.outside + counts_.in_pause, "point is", "points are").c_str(),
                   counts_.outside, counts_.in_pause);
    }
    const bool differs =
        !was_stopped_ && result_.scans_read && *result_.scans_read != report.scans_read;
    if (differs) {
      std::fprintf(stderr,
                   "trajlo_convert: the recording has changed: %s read, %zu when it "
                   "was run\n",
                   CountOf(report.scans_read, "scan was", "scans were").c_str(),
                   *result_.scans_read);
    }
    return differs || report.IsPartial() ? ExitCode::kPartialInput : ExitCode::kOk;
  }

  std::size_t scans() const { return scans_; }
  const PlacementCounts& counts() const { return counts_; }

 private:
  const ConvertRequest& request_;
  const RunResult& result_;
  std::unique_ptr<ScanSource> recording_;
  PlacementCounts counts_;
  std::size_t scans_ = 0;
  bool was_stopped_ = false;
};

double VoxelOf(const ConvertRequest& request, const RunResult& result) {
  if (request.exports.voxel_m > 0.0) return request.exports.voxel_m;
  return result.config.odometry.map.finest.min_point_spacing_m;
}

ExitCode WritePosesOf(const ConvertRequest& request, const RunResult& result) {
  std::vector<StampedPose> poses;
  for (const ControlPose& pose : result.trajectory.poses()) {
    poses.push_back({pose.t_ns, pose.T_world_body});
  }
  return WritePoseFile(request, poses);
}

ExitCode WriteMap(const ConvertRequest& request, const RunResult& result,
                  const std::atomic<bool>& stop) {
  Replay replay(request, result, RecordingOf(request, result));
  SurfaceMap map(VoxelOf(request, result));
  replay.Run(stop, [&](const PlacedScan& scan) { map.Add(scan); });
  const ExitCode code = replay.Judge();
  const std::vector<Surfel> surfels = map.Surfels();
  WriteMapFile(request.output, surfels, ColorsOf(surfels, request.exports.color),
               request.WhatIfExists());
  if (!request.quiet) {
    std::printf("map of %s, one per voxel of %g m, from %.2f million, in %s\n",
                CountOf(surfels.size(), "point").c_str(), VoxelOf(request, result),
                1e-6 * static_cast<double>(replay.counts().placed), request.output.c_str());
  }
  return code;
}

ExitCode WriteScanFolder(const ConvertRequest& request, const RunResult& result,
                         const std::atomic<bool>& stop) {
  const std::vector<std::string> inputs = RecordingOf(request, result);
  Replay replay(request, result, inputs);
  PrepareScanFolder(request.output, request.WhatIfExists());
  const std::size_t lidars = LidarsOf(inputs, result);
  std::vector<std::unique_ptr<PlacedScanFolder>> folders;
  for (std::size_t i = 0; i < lidars; ++i) {
    const fs::path own =
        lidars == 1 ? request.output : request.output / ("lidar" + std::to_string(i));
    folders.push_back(
        std::make_unique<PlacedScanFolder>(own, request.exports.scan_files, request.exports.frame));
  }
  replay.Run(stop, [&](const PlacedScan& scan) {
    folders.at(static_cast<std::size_t>(scan.lidar_id))->Write(scan);
  });
  const ExitCode code = replay.Judge();
  for (const auto& folder : folders) folder->Close();
  if (!request.quiet) {
    std::printf("%s in the %s frame, and their poses, in %s\n",
                CountOf(replay.scans(), "deskewed scan").c_str(),
                request.exports.frame == PointFrame::kBody ? "body" : "world",
                request.output.c_str());
  }
  return code;
}

/// The scans and the map, as far as they are wanted.
ExitCode WritePointsToBag(const ConvertRequest& request, const RunResult& result,
                          const std::vector<std::string>& inputs, const std::atomic<bool>& stop,
                          ResultBag* bag) {
  Replay replay(request, result, inputs);
  SurfaceMap map(VoxelOf(request, result));
  replay.Run(stop, [&](const PlacedScan& scan) {
    if (request.exports.scans) bag->WriteScan(scan);
    if (request.exports.map) map.Add(scan);
  });
  const ExitCode code = replay.Judge();
  std::size_t written = 0;
  if (request.exports.map) written = bag->WriteMap(map.Surfels());
  if (!request.quiet) {
    std::printf("%s, map of %s\n",
                CountOf(request.exports.scans ? replay.scans() : 0, "deskewed scan").c_str(),
                CountOf(written, "point").c_str());
    if (written < map.size()) std::printf("the map has %zu points; thinned\n", map.size());
  }
  return code;
}

ExitCode WriteBag(const ConvertRequest& request, const RunResult& result,
                  const std::atomic<bool>& stop) {
  const bool needs_recording = request.exports.scans || request.exports.map;
  const std::vector<std::string> inputs =
      needs_recording ? RecordingOf(request, result) : result.inputs;
  const auto output = OpenBag(request.output, request.compression, request.WhatIfExists());
  ResultBag bag(result, request.exports.frame, LidarsOf(inputs, result), output.get());
  ExitCode code = ExitCode::kOk;
  if (needs_recording) code = WritePointsToBag(request, result, inputs, stop, &bag);
  bag.Finish();
  output->Close();
  if (!request.quiet) {
    std::printf("%s as TF, odometry and path, in %s\n",
                CountOf(result.trajectory.poses().size(), "pose").c_str(), request.output.c_str());
  }
  return code;
}

}  // namespace

ExitCode ExportResult(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const RunResult result = ReadRunResult(request.input, {request.exports.keep_lost});
  ProtectResult(request, result);
  WarnOfResult(request.input, result);
  const fs::path extension = request.output.extension();
  if (extension == ".tum" || extension == ".txt") return WritePosesOf(request, result);
  if (extension == ".pcd" || extension == ".ply") return WriteMap(request, result, stop);
  if (IsBagName(request.output)) return WriteBag(request, result, stop);
  return WriteScanFolder(request, result, stop);
}

}  // namespace trajlo
