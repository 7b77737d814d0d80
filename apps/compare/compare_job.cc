// SPDX-License-Identifier: MIT
#include "apps/compare/compare_job.h"

#include <cstdio>
#include <filesystem>

#include "apps/compare/compare_report.h"
#include "apps/compare/free_run.h"
#include "apps/compare/lockstep_run.h"
#include "apps/compare/truth_error.h"
#include "apps/print_warnings.h"
#include "core/evaluation/evaluation_error.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/stamp_text.h"
#include "core/report/draw_script.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

void PrepareFolder(const CompareRequest& request) {
  std::error_code error;
  if (fs::exists(request.output, error) && !fs::is_directory(request.output, error)) {
    throw OutputError(request.output, "is there and is no folder");
  }
  const bool is_there = fs::exists(fs::path(request.output) / "comparison.json", error);
  if (is_there && !request.overwrite) {
    throw OutputError(request.output, "holds a comparison already; --overwrite replaces it");
  }
  fs::create_directories(request.output, error);
  if (error) throw OutputError(request.output, error.message());
  if (!is_there) return;
  // What an earlier comparison left would be taken for this one's.
  for (const char* name :
       {"comparison.json", "config.yaml", "lockstep.csv", "iterations.csv", "lockstep_summary.csv",
        "free_summary.csv", "report.html", "free", "figures"}) {
    fs::remove_all(fs::path(request.output) / name, error);
    if (error) throw OutputError(request.output, error.message());
  }
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

std::optional<double> ErrorOf(const FreeResult& result, const std::optional<TimedPoses>& truth) {
  try {
    if (truth) return PositionError(*truth, result.poses);
  } catch (const EvaluationError& error) {
    std::fprintf(stderr, "trajlo_compare_solvers: %s: %s\n", result.name.c_str(), error.what());
  }
  return std::nullopt;
}

/// Writes after each part, so that what was computed is there whatever comes.
void Compare(const CompareRequest& request, const std::atomic<bool>& stop, CompareReport* report) {
  std::optional<TimedPoses> truth;
  if (!request.truth.empty()) truth = ReadTruth(request.truth);
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
  if (!request.free) return;
  for (const SolverVariant& variant : request.variants) {
    if (stop) return;
    FreeResult result = RunFree(request, variant, stop);
    result.ate_rmse_m = ErrorOf(result, truth);
    report->free.push_back(std::move(result));
    CompareWithFirst(report->free.front(), &report->free.back());
    Write(request, *report);
  }
}

/// What is to be said of the recording, and of the runs; what is worse wins.
ExitCode Judge(const CompareReport& report, bool was_interrupted) {
  const Feed& read = report.free.empty() ? report.lockstep_feed : report.free.front().feed;
  PrintWarnings("trajlo_compare_solvers", read.warnings);
  ExitCode code = ExitCode::kOk;
  const auto say = [&](ExitCode worse, const std::string& text) {
    std::fprintf(stderr, "trajlo_compare_solvers: %s\n", text.c_str());
    code = worse;
  };
  if (!read.missing_input.empty()) say(ExitCode::kPartialInput, read.missing_input);
  if (const auto at_ns = report.lockstep_feed.lost_at_ns) {
    say(ExitCode::kLost, "the run in lockstep got lost at " + FormatSeconds(*at_ns) + " s");
  }
  for (const FreeResult& result : report.free) {
    if (!result.feed.lost_at_ns) continue;
    say(ExitCode::kLost,
        "'" + result.name + "' got lost at " + FormatSeconds(*result.feed.lost_at_ns) + " s");
  }
  if (was_interrupted) {
    say(ExitCode::kInterrupted, "a signal ended the comparison early; the last run is not whole");
  }
  return code;
}

}  // namespace

ExitCode RunComparison(const CompareRequest& request, const std::atomic<bool>& stop) {
  PrepareFolder(request);
  CompareReport report;
  Compare(request, stop, &report);
  const std::string problem =
      request.draw ? RunDrawScript("draw_comparison.py", request.output) : "";
  if (!problem.empty()) {
    std::fprintf(stderr, "trajlo_compare_solvers: no figures: %s\n", problem.c_str());
  }
  if (!request.quiet) std::fputs(CompareTables(report).c_str(), stdout);
  return Judge(report, stop);
}

}  // namespace trajlo
