// SPDX-License-Identifier: MIT
#include "apps/evaluate/evaluate_job.h"

#include <cstdio>

#include "apps/evaluate/evaluation_table.h"
#include "apps/evaluate/labels.h"
#include "apps/evaluate/output_folder.h"
#include "apps/print_warnings.h"
#include "core/evaluation/evaluation_error.h"
#include "core/export/run_result.h"
#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/scan_stamps.h"
#include "core/report/draw_script.h"

namespace trajlo {
namespace {

constexpr char kCommand[] = "trajlo_evaluate";

struct NamedPoses {
  TimedPoses poses;
  TrajectorySummary summary;
  bool has_rotations = true;
};

NamedPoses Read(const std::filesystem::path& path, TrajectoryFormat format,
                const EvaluateRequest& request, std::vector<std::string>* warnings) {
  TrajectoryFile file = ReadTrajectory(path, format, warnings);
  NamedPoses read;
  read.summary.format = TrajectoryFormatName(file.format);
  if (file.t_ns.empty() && !request.times.empty()) {
    file.t_ns = ReadStampsFile(request.times);
    if (file.t_ns.size() != file.T_world_body.size()) {
      throw InputError(request.times,
                       "has " + CountOf(file.t_ns.size(), "stamp") + ", and " + path.string() +
                           " " + CountOf(file.T_world_body.size(), "pose"),
                       "There must be one stamp for each line.");
    }
  }
  read.has_rotations = file.has_rotations;
  read.poses = OrderByTime(file, path.string(), request.repeated_stamps, warnings);
  read.summary.file = path.string();
  read.summary.poses = read.poses.size();
  read.summary.path_length_m = PathLength(read.poses.T_world_body);
  read.summary.has_stamps = read.poses.HasStamps();
  if (read.summary.has_stamps) {
    read.summary.begin_ns = read.poses.t_ns.front();
    read.summary.end_ns = read.poses.t_ns.back();
  }
  return read;
}

/// What the run that made an estimate says against it.
void WarnOfRun(const std::filesystem::path& estimate, std::vector<std::string>* warnings) {
  std::error_code error;
  const bool is_folder = std::filesystem::is_directory(estimate, error);
  const std::filesystem::path folder = is_folder ? estimate : estimate.parent_path();
  if (!is_folder && estimate.filename() != "trajectory.tum") return;
  const std::string shortcoming = IsRunResult(folder) ? RunShortcoming(folder) : "";
  if (!shortcoming.empty()) {
    warnings->push_back(estimate.string() + ": trajlo_run reported: " + shortcoming);
  }
}

EstimateReport EvaluateOne(std::size_t index, const EvaluateRequest& request,
                           const TimedPoses& truth, std::vector<std::string>* warnings) {
  EstimateReport report;
  report.name = request.names[index];
  const std::filesystem::path& path = request.estimates[index];
  report.trajectory.file = path.string();
  try {
    const NamedPoses estimate = Read(path, request.estimate_format, request, warnings);
    report.trajectory = estimate.summary;
    if (!estimate.has_rotations) {
      warnings->push_back(path.string() +
                          ": has positions without rotations, so its rotation errors say nothing");
    }
    WarnOfRun(path, warnings);
    report.evaluation = Evaluate(estimate.poses, truth, request.options);
    for (const std::string& warning : report.evaluation->warnings) {
      warnings->push_back(path.string() + ": " + warning);
    }
  } catch (const InputError& error) {
    report.failure = error.what();
  } catch (const EvaluationError& error) {
    report.failure = path.string() + ": " + error.what();
  }
  return report;
}

/// Reads everything and compares each estimate with the truth.
EvaluationReport Compare(const EvaluateRequest& request) {
  EvaluationReport report;
  const NamedPoses truth = Read(request.truth, request.truth_format, request, &report.warnings);
  report.truth = truth.summary;
  report.truth_has_orientation = UsesOrientation(truth.poses, request.options.truth_orientation);
  if (!report.truth_has_orientation &&
      request.options.truth_orientation == TruthOrientation::kAuto) {
    report.warnings.push_back(
        request.truth.string() +
        (truth.has_rotations
             ? ": all rotations are exactly the identity, so they are taken as placeholders and no "
               "rotation error is computed (--truth_orientation=use computes it)"
             : ": has positions without rotations, so no rotation error is computed"));
  }
  const std::vector<std::string> file_names = FileNames(request.names);
  for (std::size_t i = 0; i < request.estimates.size(); ++i) {
    report.estimates.push_back(EvaluateOne(i, request, truth.poses, &report.warnings));
    report.estimates.back().errors_csv = "errors_" + file_names[i] + ".csv";
  }
  return report;
}

/// Prints why estimates could not be compared, and returns how many.
std::size_t PrintFailures(const EvaluationReport& report) {
  std::size_t failures = 0;
  for (const EstimateReport& estimate : report.estimates) {
    if (estimate.evaluation) continue;
    std::fprintf(stderr, "%s: %s\n", kCommand, estimate.failure.c_str());
    ++failures;
  }
  return failures;
}

/// Returns whether all that was asked for could be written.
bool WriteAndDraw(const EvaluateRequest& request, const EvaluationReport& report) {
  WriteEvaluation(request, report);
  const DrawOutcome drawn =
      request.draw ? RunDrawScript("draw_evaluation.py", request.output) : DrawOutcome();
  if (!drawn.problem.empty()) PrintWarnings(kCommand, {"no figures: " + drawn.problem});
  if (!request.quiet) std::printf("result      %s\n", request.output.c_str());
  return !drawn.output_failed;
}

}  // namespace

ExitCode EvaluateJob(const EvaluateRequest& request) {
  const bool writes = !request.output.empty();
  if (writes) CheckEvaluationFolder(request.output, request.overwrite);
  const EvaluationReport report = Compare(request);
  PrintWarnings(kCommand, report.warnings);
  const std::size_t failures = PrintFailures(report);
  if (failures == report.estimates.size()) return ExitCode::kInputUnreadable;
  if (!request.quiet) std::fputs(EvaluationTable(request, report).c_str(), stdout);
  std::fflush(stdout);
  if (writes && !WriteAndDraw(request, report)) return ExitCode::kOutputNotWritable;
  return failures > 0 ? ExitCode::kPartialInput : ExitCode::kOk;
}

}  // namespace trajlo
