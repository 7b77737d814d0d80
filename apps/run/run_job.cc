// SPDX-License-Identifier: MIT
#include "apps/run/run_job.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <sstream>

#include "apps/failure_text.h"
#include "apps/print_warnings.h"
#include "apps/run/run.h"
#include "core/io/atomic_file.h"
#include "core/io/disk_reserve.h"
#include "core/io/errors.h"
#include "core/io/recording/open_recording.h"
#include "core/io/stamp_text.h"
#include "core/report/resource_usage.h"
#include "core/report/result_folder.h"
#include "core/report/run_json.h"
#include "core/report/summary_table.h"

namespace trajlo {
namespace {

using Clock = std::chrono::steady_clock;

/// Kept for the last run.json, which is a few kB.
constexpr std::size_t kReserve_bytes = 64 << 10;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

void End(ExitCode code, const char* reason, const std::string& message, RunSummary* summary) {
  summary->exit_code = static_cast<int>(code);
  summary->exit_reason = reason;
  summary->message = message;
}

/// The outcome of a run that came to its end; what is worse wins.
void JudgeOutcome(bool interrupted, RunSummary* s) {
  if (interrupted) {
    End(ExitCode::kInterrupted, "interrupted", "a signal ended the run early", s);
  } else if (s->points.received == 0) {
    End(ExitCode::kInputUnreadable, "no_usable_points",
        "no points were read: the scans are empty, or input.start_s lies after their end", s);
  } else if (!s->begin_ns || s->points.Kept() == 0) {
    End(ExitCode::kInputUnreadable, "no_usable_points",
        "none of the " + std::to_string(s->points.received) +
            " points can be used; see the counts of dropped ones, and sensor.min_range_m and "
            "sensor.max_range_m",
        s);
  } else if (s->lost_at_ns) {
    End(ExitCode::kLost, "lost",
        "the estimator got lost at " + FormatSeconds(*s->lost_at_ns) +
            " s; poses from there on are not to be trusted (flags.csv and windows.csv show what "
            "happened)",
        s);
  } else if (const std::string shortcomings = s->Shortcomings(); !shortcomings.empty()) {
    const char* more = s->warnings.empty() ? "" : "; the warnings say more";
    End(ExitCode::kPartialInput, "partial_input", shortcomings + more, s);
  } else {
    End(ExitCode::kOk, "ok", "", s);
  }
}

/// Reads, estimates and writes; throws OutputError.
void Execute(const RunRequest& request, const ResultFolder& folder, ScanSource* recording,
             const std::atomic<bool>& stop, RunSummary* summary) {
  // Until the end it says "running": if the process is killed, nobody takes the result for whole.
  WriteRunJson(folder.summary(), *summary);
  WriteTextFile(folder.config(), DumpConfig(request.config), IfExists::kReplace);
  Run run(request, folder, recording, summary);
  std::string failure;
  try {
    try {
      run.Estimate(stop);
    } catch (const OutputError&) {
      throw;
    } catch (const std::exception& error) {
      failure = FailureText(error);
    }
    run.Write();
  } catch (const OutputError&) {
    run.Summarise();
    throw;
  }
  run.Summarise();
  JudgeOutcome(stop, summary);
  if (!failure.empty()) {
    End(ExitCode::kFailed, "failed", failure + " (while estimating)", summary);
  }
}

RunSummary StartSummary(const RunRequest& request) {
  RunSummary summary;
  summary.command_line = request.command_line;
  summary.inputs = request.inputs;
  summary.output = request.output;
  const bool ceres = request.config.odometry.solver.kind == SolverKind::kCeres;
  summary.solver = ceres ? "ceres" : "gauss_newton";
  summary.threads = request.config.odometry.threads;
  return summary;
}

/// How the recording is read, and what is done to its points.
std::string Understood(const ScanSource& recording, const RunRequest& request) {
  std::ostringstream text;
  text << recording.description();
  const double up_deg = request.config.odometry.segmenter.vertical_correction_deg;
  if (up_deg != 0.0) {
    text << "\nevery ray is turned up by " << up_deg << " degrees (sensor.vertical_correction_deg)";
  }
  return text.str();
}

void Print(const RunRequest& request, const RunSummary& summary) {
  PrintWarnings("trajlo_run", summary.warnings, " are in run.json");
  // If the output failed before anything was read, there is nothing to count.
  const bool has_read = summary.read.scans_listed > 0;
  if (!request.quiet && has_read) std::fputs(SummaryTable(summary).c_str(), stdout);
  if (!summary.message.empty()) {
    std::fprintf(stderr, "trajlo_run: %s\n", summary.message.c_str());
  }
}

}  // namespace

ExitCode RunJob(const RunRequest& request, const std::atomic<bool>& stop) {
  const Clock::time_point begin = Clock::now();
  const ResultFolder folder(request.output);
  RunSummary summary = StartSummary(request);
  bool prepared = false;
  std::optional<DiskReserve> reserve;
  try {
    folder.Check(request.overwrite);
    const std::unique_ptr<ScanSource> recording =
        OpenRecording(request.inputs, request.config.input, request.config.odometry.threads);
    const std::string understood = Understood(*recording, request);
    summary.input_description = Lines(understood);
    if (!request.quiet) std::printf("%s\n", understood.c_str());
    std::fflush(stdout);
    folder.Prepare();
    prepared = true;
    reserve.emplace(request.output, kReserve_bytes);
    Execute(request, folder, recording.get(), stop, &summary);
  } catch (const OutputError& error) {
    End(ExitCode::kOutputNotWritable, "output_not_writable", error.what(), &summary);
  } catch (const InputError& error) {
    End(ExitCode::kInputUnreadable, "input_unreadable", error.what(), &summary);
  } catch (const std::exception& error) {
    End(ExitCode::kFailed, "failed", FailureText(error), &summary);
  }
  summary.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  summary.cpu_s = ProcessCpuSeconds();
  summary.peak_memory_mb = PeakMemoryMegabytes();
  if (!prepared) {
    std::fprintf(stderr, "trajlo_run: %s\n", summary.message.c_str());
    return static_cast<ExitCode>(*summary.exit_code);
  }
  try {
    reserve.reset();  // On a disk that is full by now, run.json would go on saying "running".
    WriteRunJson(folder.summary(), summary);
  } catch (const OutputError& error) {
    std::fprintf(stderr, "trajlo_run: %s\n", error.what());
    summary.exit_code = static_cast<int>(ExitCode::kOutputNotWritable);
  }
  Print(request, summary);
  return static_cast<ExitCode>(*summary.exit_code);
}

}  // namespace trajlo
