// SPDX-License-Identifier: MIT
#include "apps/compare/compare_job.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "apps/compare/compare_report.h"
#include "apps/compare/compare_warnings.h"
#include "apps/compare/free_run.h"
#include "apps/compare/lockstep_run.h"
#include "apps/compare/truth_error.h"
#include "apps/print_warnings.h"
#include "core/comparison/variant_doubt.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/recording/open_recording.h"
#include "core/io/stamp_text.h"
#include "core/report/draw_script.h"
#include "core/report/drawn_files.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

constexpr char kCommand[] = "trajlo_compare_solvers";
constexpr char kNoRuns[] =
    "--truth is not used: it is for the errors of whole runs, and --mode=lockstep has none";
constexpr std::size_t kStampsToLookAt = 15;
/// The end of a recording is not known before all is read. On average no scan takes longer, pauses
/// included.
constexpr double kLongestScan_s = 1.0;

void PrepareFolder(const CompareRequest& request) {
  std::error_code error;
  if (fs::exists(request.output, error) && !fs::is_directory(request.output, error)) {
    throw OutputError(request.output, "exists and is not a folder");
  }
  const bool is_there = fs::exists(fs::path(request.output) / "comparison.json", error);
  if (is_there && !request.overwrite) {
    throw OutputError(request.output, "holds a comparison already; --overwrite replaces it");
  }
  fs::create_directories(request.output, error);
  if (error) throw OutputError(request.output, error.message());
  if (!is_there) return;
  RemoveComparison(request.output);
}

void Write(const CompareRequest& request, const CompareReport& report) {
  const fs::path folder = request.output;
  const auto write = [&](const char* name, const std::string& text) {
    if (!text.empty()) WriteTextFile(folder / name, text, IfExists::kReplace);
  };
  write("config.yaml", DumpConfig(request.config));
  write("lockstep_summary.csv", LockstepSummaryCsv(report));
  write("free_summary.csv", FreeSummaryCsv(report));
  write("comparison.json", CompareJson(request, report));
}

/// A truth of another time is of no use, and better known before the runs than after.
void RequireOverlap(const CompareRequest& request, const TimedPoses& truth) {
  if (!truth.HasStamps()) {
    throw InputError(request.truth, "has no stamps, and the poses of the runs are found by them",
                     "Give a truth in TUM's or EuRoC's format.");
  }
  const auto recording = OpenRecording(request.inputs, request.config.input);
  std::vector<std::int64_t> stamps_ns;
  LidarScan scan;
  while (stamps_ns.size() < kStampsToLookAt && recording->Next(&scan)) {
    stamps_ns.push_back(scan.stamp_ns);
  }
  if (stamps_ns.empty()) return;  // The runs say more.
  // A few stamps may be wrong, but not the one in the middle.
  const auto middle = stamps_ns.begin() + static_cast<std::ptrdiff_t>(stamps_ns.size() / 2);
  std::nth_element(stamps_ns.begin(), middle, stamps_ns.end());
  const double begin_s = Seconds(*middle) - kLongestScan_s * kStampsToLookAt;
  const double end_s = Seconds(*middle) + kLongestScan_s * static_cast<double>(recording->size());
  if (Seconds(truth.t_ns.back()) >= begin_s && Seconds(truth.t_ns.front()) <= end_s) return;
  throw InputError(request.truth,
                   "is of another time than the recording: from " +
                       FormatSeconds(truth.t_ns.front()) + " to " +
                       FormatSeconds(truth.t_ns.back()) + " s, and the recording begins at about " +
                       FormatSeconds(*middle) + " s",
                   "Without --truth the solvers are compared all the same.");
}

/// Writes after each part, so that what was computed is there whatever comes.
void Compare(const CompareRequest& request, const std::optional<TimedPoses>& truth,
             const std::atomic<bool>& stop, CompareReport* report) {
  if (request.lockstep) {
    for (const SolverVariant& variant : request.variants) {
      if (IsAboutOneWindow(variant, request.config)) {
        report->lockstep_variants.push_back(variant);
      } else {
        report->not_in_lockstep.push_back(variant.name);
      }
    }
    report->lockstep =
        RunLockstep(request, report->lockstep_variants, stop, &report->lockstep_feed);
    Write(request, *report);
  }
  for (const SolverVariant& variant : request.variants) {
    if (!request.free || stop) break;
    FreeResult result = RunFree(request, variant, stop);
    if (truth) result.truth_error = CompareWithTruth(*truth, result.poses);
    report->free.push_back(std::move(result));
    CompareWithFirst(report->free.front(), &report->free.back());
    Write(request, *report);
  }
  report->is_whole = !stop;
  Write(request, *report);
}

/// What is to be said of the recording, and of the runs; what is worse wins.
ExitCode Judge(const CompareReport& report, bool has_truth, bool was_interrupted) {
  const Feed& read = report.free.empty() ? report.lockstep_feed : report.free.front().feed;
  PrintWarnings(kCommand, read.warnings);
  PrintWarnings(kCommand, WarningsOfRuns(report), " are in comparison.json");
  ExitCode code = ExitCode::kOk;
  const auto say = [&](ExitCode worse, const std::string& text) {
    std::fprintf(stderr, "%s: %s\n", kCommand, text.c_str());
    code = worse;
  };
  if (!read.shortcomings.empty()) say(ExitCode::kPartialInput, read.shortcomings);
  if (!HasWindows(report) && !was_interrupted) {
    say(ExitCode::kPartialInput,
        "nothing was compared: no window was estimated. The recording, or what input.start_s and "
        "input.duration_s leave of it, is too short or has no usable points");
  }
  if (const auto at_ns = report.lockstep_feed.lost_at_ns) {
    say(ExitCode::kLost, "the run in lockstep got lost at " + FormatSeconds(*at_ns) + " s");
  }
  for (const FreeResult& result : report.free) {
    if (!result.feed.lost_at_ns) continue;
    say(ExitCode::kLost,
        "'" + result.name + "' got lost at " + FormatSeconds(*result.feed.lost_at_ns) + " s");
  }
  for (const std::string& failure : FailuresOfRuns(report)) {
    std::fprintf(stderr, "%s: %s\n", kCommand, failure.c_str());
  }
  const bool no_errors = std::none_of(report.free.begin(), report.free.end(),
                                      [](const FreeResult& run) { return run.AteRmse_m(); });
  if (has_truth && !report.free.empty() && no_errors && code == ExitCode::kOk) {
    say(ExitCode::kPartialInput, "no run could be compared with the truth");
  }
  if (was_interrupted) {
    say(ExitCode::kInterrupted, "a signal ended the comparison early; the last run is not whole");
  }
  return code;
}

}  // namespace

ExitCode RunComparison(const CompareRequest& request, const std::atomic<bool>& stop) {
  CompareReport report;
  report.warnings = DoubtVariants(request.variants, request.config, request.lockstep);
  std::optional<TimedPoses> truth;
  if (!request.truth.empty()) {
    truth = ReadTruth(request.truth, &report.warnings);
    RequireOverlap(request, *truth);
    if (!request.free) report.warnings.emplace_back(kNoRuns);
  }
  PrepareFolder(request);
  PrintWarnings(kCommand, report.warnings);
  Compare(request, truth, stop, &report);
  const DrawOutcome drawn =
      request.draw ? RunDrawScript("draw_comparison.py", request.output) : DrawOutcome();
  if (!drawn.problem.empty()) {
    std::fprintf(stderr, "%s: no figures: %s\n", kCommand, drawn.problem.c_str());
  }
  if (!request.quiet) std::fputs(CompareTables(report).c_str(), stdout);
  const ExitCode code = Judge(report, !request.truth.empty(), stop);
  return drawn.output_failed && code == ExitCode::kOk ? ExitCode::kOutputNotWritable : code;
}

}  // namespace trajlo
