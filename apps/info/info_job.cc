// SPDX-License-Identifier: MIT
#include "apps/info/info_job.h"

#include <algorithm>
#include <cstdio>

#include "apps/info/info_json.h"
#include "apps/info/info_table.h"
#include "core/io/errors.h"
#include "core/io/inspection/inspect_recording.h"
#include "core/report/progress_bar.h"

namespace trajlo {
namespace {

/// Enough for the convention, the period and a first look at the points.
constexpr std::size_t kQuickMessages = 20;

RecordingInspection Inspect(const std::string& path, const InfoRequest& request,
                            const std::atomic<bool>& stop) {
  ProgressBar progress(stderr, request.quiet);
  InspectionOptions options;
  options.clouds.packets.velodyne_model = request.velodyne_model;
  options.clouds.threads = 0;
  options.messages_per_lidar = request.quick ? kQuickMessages : 0;
  options.on_progress = [&](std::size_t done, std::size_t all) { progress.Update(done, all); };
  options.should_stop = [&] { return stop.load(); };
  return InspectRecording(path, options);
}

}  // namespace

ExitCode InfoJob(const InfoRequest& request, const std::atomic<bool>& stop) {
  std::vector<RecordingInspection> found;
  bool unreadable = false;
  for (const std::string& path : request.recordings) {
    if (stop) break;
    try {
      found.push_back(Inspect(path, request, stop));
    } catch (const InputError& error) {
      std::fprintf(stderr, "trajlo_info: %s\n", error.what());
      unreadable = true;
      continue;
    }
    unreadable = unreadable || (!stop && found.back().IsWithoutReturns());
    if (request.json) continue;
    std::printf("%s%s", found.size() > 1 ? "\n\n" : "",
                InfoTable(found.back(), request.program_folder).c_str());
    std::fflush(stdout);
  }
  if (request.json) std::fputs(InfoJson(found).c_str(), stdout);
  if (stop) return ExitCode::kInterrupted;
  if (unreadable) return ExitCode::kInputUnreadable;
  const bool damaged = std::any_of(found.begin(), found.end(),
                                   [](const RecordingInspection& one) { return one.damaged; });
  return damaged ? ExitCode::kPartialInput : ExitCode::kOk;
}

}  // namespace trajlo
