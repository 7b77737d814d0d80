// SPDX-License-Identifier: MIT
#include "apps/convert/convert_job.h"

#include <cmath>
#include <cstdio>

#include "apps/convert/convert_scans.h"
#include "apps/convert/export_result.h"
#include "apps/convert/pose_files.h"
#include "apps/convert/protect_input.h"
#include "apps/print_warnings.h"
#include "core/export/run_result.h"
#include "core/io/conversion/extract_poses.h"
#include "core/io/conversion/message_copy.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/io/trajectory_writer.h"
#include "core/report/progress_bar.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr char kCommand[] = "trajlo_convert";

/// The poses of the excerpt; throws InputError if there are none.
std::vector<StampedPose> WantedPoses(const ConvertRequest& request,
                                     const std::vector<StampedPose>& poses) {
  if (request.recording.start_s == 0.0 && request.recording.duration_s == 0.0) return poses;
  const std::int64_t begin_ns = poses.front().t_ns + Nanoseconds(request.recording.start_s);
  const std::int64_t duration_ns = Nanoseconds(request.recording.duration_s);
  std::vector<StampedPose> wanted;
  for (const StampedPose& pose : poses) {
    if (pose.t_ns < begin_ns) continue;
    if (duration_ns > 0 && pose.t_ns >= begin_ns + duration_ns) continue;
    wanted.push_back(pose);
  }
  if (wanted.empty()) {
    throw InputError(request.input,
                     "none of the " + std::to_string(poses.size()) + " poses of " + request.poses +
                         " lies in the part to convert",
                     "Check --start_s and --duration_s with trajlo_info.");
  }
  return wanted;
}

ExitCode WritePoses(const ConvertRequest& request) {
  const ExtractedPoses extracted = ExtractPoses(request.input, request.poses);
  const std::vector<StampedPose> wanted = WantedPoses(request, extracted.poses);
  TumWriter tum(request.output, request.WhatIfExists());
  for (const StampedPose& pose : wanted) tum.Append(pose.t_ns, pose.T_world_body);
  tum.Flush();
  tum.Close();
  PrintWarnings(kCommand, extracted.report.warnings);
  if (extracted.unreadable > 0) {
    std::fprintf(stderr, "trajlo_convert: %s no pose\n",
                 CountOf(extracted.unreadable, "message holds", "messages hold").c_str());
  }
  if (!request.quiet) {
    std::printf("%s in %s\n", CountOf(wanted.size(), "pose").c_str(), request.output.c_str());
  }
  const bool partial =
      extracted.report.damaged || extracted.unreadable + extracted.contradicted > 0;
  return partial ? ExitCode::kPartialInput : ExitCode::kOk;
}

/// Calls `copy(options)` with what is wanted, and shows how far it is.
template <typename Copy>
MessageCopyResult CopyWanted(const ConvertRequest& request, const std::atomic<bool>& stop,
                             Copy&& copy) {
  MessageCopyOptions options;
  options.topics = request.recording.topics;
  options.start_ns = Nanoseconds(request.recording.start_s);
  options.duration_ns = Nanoseconds(request.recording.duration_s);
  ProgressBar progress(stderr, request.quiet);
  options.on_progress = [&](std::size_t done, std::size_t all) { progress.Update(done, all); };
  options.should_stop = [&] { return stop.load(); };
  return copy(options);
}

ExitCode CopyRos1Bags(const ConvertRequest& request, const std::atomic<bool>& stop) {
  Ros1BagOptions bag;
  if (!request.compression.empty()) {
    bag.compression = *ros1::FindCompression(request.compression);
  }
  bag.if_exists = request.WhatIfExists();
  const MessageCopyResult copied =
      CopyWanted(request, stop, [&](const MessageCopyOptions& options) {
        return CopyBags(Ros1BagsOf(request.input), request.output, options, bag);
      });
  PrintWarnings(kCommand, copied.report.warnings);
  if (!request.quiet) {
    std::printf("%s copied as recorded to %s\n", CountOf(copied.messages, "message").c_str(),
                request.output.c_str());
  }
  return copied.report.damaged ? ExitCode::kPartialInput : ExitCode::kOk;
}

/// From one kind of bag to another.
ExitCode CopyMessagesOver(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const auto bag = OpenBag(request.output, request.compression, request.WhatIfExists());
  const MessageCopyResult copied =
      CopyWanted(request, stop, [&](const MessageCopyOptions& options) {
        return CopyMessages(request.input, options, bag.get());
      });
  PrintWarnings(kCommand, copied.report.warnings);
  for (const auto& [topic, reason] : copied.left_out) {
    std::fprintf(stderr, "trajlo_convert: %s is left out: %s\n", topic.c_str(), reason.c_str());
  }
  if (copied.messages == 0) {
    throw InputError(request.input, "there is no message in the part to copy",
                     "Check --topics, --start_s and --duration_s with trajlo_info.");
  }
  bag->Close();
  if (!request.quiet) {
    std::printf("%s with all fields in %s\n", CountOf(copied.messages, "message").c_str(),
                request.output.c_str());
  }
  const bool partial = copied.report.damaged || !copied.left_out.empty();
  return partial ? ExitCode::kPartialInput : ExitCode::kOk;
}

ExitCode WriteScans(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const ConvertedScans converted = ConvertScans(request, stop);
  PrintWarnings(kCommand, converted.report.warnings);
  if (!request.quiet) {
    std::printf("%s of %s, %.2f million points, in %s\n", CountOf(converted.scans, "scan").c_str(),
                CountOf(converted.lidars, "LiDAR").c_str(),
                1e-6 * static_cast<double>(converted.points), request.output.c_str());
  }
  return converted.report.IsPartial() ? ExitCode::kPartialInput : ExitCode::kOk;
}

ExitCode Convert(const ConvertRequest& request, const std::atomic<bool>& stop) {
  if (IsRunResult(request.input)) return ExportResult(request, stop);
  if (IsTrajectoryFile(request.input)) return ConvertTrajectory(request);
  ProtectInput(FilesOfRecording(InputPaths(request.input), request.recording), request.output);
  if (!request.poses.empty()) return WritePoses(request);
  const bool copy = request.WritesBag() && !request.layout && HoldsMessages(request.input);
  if (!copy) return WriteScans(request, stop);
  const bool is_ros1 = !Ros1BagsOf(request.input).empty() && request.output.extension() == ".bag";
  return is_ros1 ? CopyRos1Bags(request, stop) : CopyMessagesOver(request, stop);
}

}  // namespace

ExitCode ConvertJob(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const ExitCode code = Convert(request, stop);
  if (!stop) return code;
  std::fprintf(stderr,
               "trajlo_convert: a signal ended it early; %s holds what was read until then\n",
               request.output.c_str());
  return ExitCode::kInterrupted;
}

}  // namespace trajlo
