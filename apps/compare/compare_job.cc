// SPDX-License-Identifier: MIT
#include "apps/compare/compare_job.h"

#include <cstdio>
#include <filesystem>

#include "apps/compare/compare_report.h"
#include "apps/compare/free_run.h"
#include "apps/compare/lockstep_run.h"
#include "apps/compare/truth_error.h"
#include "core/evaluation/evaluation_error.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/report/draw_script.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

void PrepareFolder(const CompareRequest& request) {
  std::error_code error;
  if (fs::exists(request.output, error) && !fs::is_directory(request.output, error)) {
    throw OutputError(request.output, "is there and is no folder");
  }
  if (fs::exists(fs::path(request.output) / "comparison.json", error) && !request.overwrite) {
    throw OutputError(request.output, "holds a comparison already; --overwrite replaces it");
  }
  fs::create_directories(request.output, error);
  if (error) throw OutputError(request.output, error.message());
  fs::remove(fs::path(request.output) / "comparison.json", error);
}

void Compare(const CompareRequest& request, CompareReport* report) {
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
    report->lockstep = RunLockstep(request, report->lockstep_variants);
  }
  if (!request.free) return;
  for (const SolverVariant& variant : request.variants) {
    FreeResult result = RunFree(request, variant);
    try {
      if (truth) result.ate_rmse_m = PositionError(*truth, result.poses);
    } catch (const EvaluationError& error) {
      std::fprintf(stderr, "trajlo_compare_solvers: %s: %s\n", variant.name.c_str(), error.what());
    }
    report->free.push_back(std::move(result));
    CompareWithFirst(report->free.front(), &report->free.back());
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

}  // namespace

void RunComparison(const CompareRequest& request) {
  PrepareFolder(request);
  CompareReport report;
  Compare(request, &report);
  Write(request, report);
  const std::string problem =
      request.draw ? RunDrawScript("draw_comparison.py", request.output) : "";
  if (!problem.empty()) {
    std::fprintf(stderr, "trajlo_compare_solvers: no figures: %s\n", problem.c_str());
  }
  if (!request.quiet) std::fputs(CompareTables(report).c_str(), stdout);
}

}  // namespace trajlo
