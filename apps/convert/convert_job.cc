// SPDX-License-Identifier: MIT
#include "apps/convert/convert_job.h"

#include <cmath>
#include <cstdio>

#include "apps/convert/convert_scans.h"
#include "apps/print_warnings.h"
#include "apps/reading_progress.h"
#include "core/io/conversion/bag_copy.h"
#include "core/io/conversion/extract_poses.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/trajectory_writer.h"

namespace trajlo {
namespace {

constexpr char kCommand[] = "trajlo_convert";

std::int64_t ToNs(double seconds) { return std::llround(1e9 * seconds); }

IfExists WhatIfExists(const ConvertRequest& request) {
  return request.overwrite ? IfExists::kReplace : IfExists::kFail;
}

ExitCode WritePoses(const ConvertRequest& request) {
  const ExtractedPoses extracted = ExtractPoses(request.input, request.poses);
  const std::int64_t begin_ns = extracted.poses.front().t_ns + ToNs(request.recording.start_s);
  const std::int64_t duration_ns = ToNs(request.recording.duration_s);
  TumWriter tum(request.output, WhatIfExists(request));
  std::size_t written = 0;
  for (const StampedPose& pose : extracted.poses) {
    if (pose.t_ns < begin_ns) continue;
    if (duration_ns > 0 && pose.t_ns >= begin_ns + duration_ns) continue;
    tum.Append(pose.t_ns, pose.T_world_body);
    ++written;
  }
  tum.Flush();
  tum.Close();
  PrintWarnings(kCommand, extracted.report.warnings);
  if (extracted.unreadable > 0) {
    std::fprintf(stderr, "trajlo_convert: %zu messages hold no pose\n", extracted.unreadable);
  }
  if (!request.quiet) std::printf("%zu poses in %s\n", written, request.output.c_str());
  const bool partial = extracted.report.damaged || extracted.unreadable > 0;
  return partial ? ExitCode::kPartialInput : ExitCode::kOk;
}

ExitCode CopyMessages(const ConvertRequest& request, const std::atomic<bool>& stop) {
  BagCopyOptions options;
  options.topics = request.recording.topics;
  options.start_ns = ToNs(request.recording.start_s);
  options.duration_ns = ToNs(request.recording.duration_s);
  options.output.compression = request.compression;
  options.output.if_exists = WhatIfExists(request);
  BagCopyResult copied;
  {
    ReadingProgress progress(stderr, request.quiet);
    options.on_progress = [&](std::size_t done, std::size_t all) { progress.Update(done, all); };
    options.should_stop = [&] { return stop.load(); };
    copied = CopyBags(Ros1BagsOf(request.input), request.output, options);
  }
  PrintWarnings(kCommand, copied.report.warnings);
  if (!request.quiet) {
    std::printf("%zu messages copied as they are to %s\n", copied.messages, request.output.c_str());
  }
  return copied.report.damaged ? ExitCode::kPartialInput : ExitCode::kOk;
}

ExitCode WriteScans(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const ConvertedScans converted = ConvertScans(request, stop);
  PrintWarnings(kCommand, converted.report.warnings);
  if (!request.quiet) {
    std::printf("%zu scans of %zu LiDAR%s, %.2f million points, in %s\n", converted.scans,
                converted.lidars, converted.lidars == 1 ? "" : "s",
                1e-6 * static_cast<double>(converted.points), request.output.c_str());
  }
  return converted.report.IsPartial() ? ExitCode::kPartialInput : ExitCode::kOk;
}

ExitCode Convert(const ConvertRequest& request, const std::atomic<bool>& stop) {
  if (!request.poses.empty()) return WritePoses(request);
  const bool copy = request.WritesBag() && !request.layout && !Ros1BagsOf(request.input).empty();
  return copy ? CopyMessages(request, stop) : WriteScans(request, stop);
}

}  // namespace

ExitCode ConvertJob(const ConvertRequest& request, const std::atomic<bool>& stop) {
  const ExitCode code = Convert(request, stop);
  return stop ? ExitCode::kInterrupted : code;
}

}  // namespace trajlo
