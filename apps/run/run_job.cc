// SPDX-License-Identifier: MIT
#include "apps/run/run_job.h"

#include <chrono>
#include <cstdio>
#include <exception>
#include <sstream>

#include "apps/failure_text.h"
#include "apps/print_warnings.h"
#include "core/comparison/forms/ceres_form_solver.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/recording/open_recording.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_writer.h"
#include "core/odometry/odometry.h"
#include "core/report/covariance_csv.h"
#include "core/report/flag_warnings.h"
#include "core/report/processing_time.h"
#include "core/report/progress_bar.h"
#include "core/report/resource_usage.h"
#include "core/report/result_folder.h"
#include "core/report/run_json.h"
#include "core/report/scan_sampler.h"
#include "core/report/summary_table.h"
#include "core/report/view_ply.h"
#include "core/report/window_csv.h"

namespace trajlo {
namespace {

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

SamplingOptions WithGaps(const RunRequest& request) {
  SamplingOptions sampling = request.sampling;
  sampling.max_gap_s = request.config.odometry.segmenter.max_gap_s;
  return sampling;
}

/// One run from the first scan to the last file. The summary belongs to the caller, who needs it
/// when a member throws.
class Run {
 public:
  Run(const RunRequest& request, const ResultFolder& folder, ScanSource* recording,
      RunSummary* summary)
      : request_(request),
        folder_(folder),
        recording_(recording),
        summary_(summary),
        sampler_(WithGaps(request)),
        trajectory_(folder.trajectory(), IfExists::kReplace),
        windows_(folder.windows(), IfExists::kReplace),
        odometry_(request.config.odometry, MakeSolverFactory(request.config.ceres_form)) {
    odometry_.OnScan([this](const LidarScan& scan) {
      sampler_.NoteScan(scan);
      if (view_) view_->Note(scan);
      if (!first_ns_) first_ns_ = scan.stamp_ns;
      newest_ns_ = scan.stamp_ns;
    });
    odometry_.OnWindow([this](const WindowStatistics& window) {
      windows_.Append(window);
      summary_->windows.Add(window);
      inlier_share_ = window.InlierShare();
    });
    if (request.view) view_.emplace(request.config.odometry.segmenter);
    if (!request.covariance) return;
    covariance_.emplace(folder.covariance(), IfExists::kReplace);
    odometry_.OnPose([this](const ControlPose& pose, const Matrix6d& covariance) {
      covariance_->Append(pose, covariance);
    });
  }

  /// Feeds the estimator; returns early when `stop` is set.
  void Estimate(const std::atomic<bool>& stop) {
    ProgressBar bar(stderr, request_.quiet);
    const Clock::time_point begin = Clock::now();
    LidarScan scan;
    for (std::size_t count = 0; !stop && recording_->Next(&scan); ++count) {
      Timed([&] { odometry_.AddScan(scan); });
      sampler_.Advance(odometry_.trajectory(), [&](std::int64_t t_ns, const SE3& T) {
        Append(t_ns, T);
        return !stop;
      });
      const std::int64_t data_ns = newest_ns_ - first_ns_.value_or(newest_ns_);
      bar.Update({count + 1, recording_->size(), 1e-9 * static_cast<double>(data_ns),
                  SecondsSince(begin), inlier_share_});
    }
    Timed([&] { odometry_.Finish(); });
  }

  /// Completes the files that grew and writes those that did not.
  void Write() {
    sampler_.Finish(odometry_.trajectory(), [this](std::int64_t t_ns, const SE3& T) {
      Append(t_ns, T);
      return true;
    });
    trajectory_.Flush();
    trajectory_.Close();
    windows_.Close();
    if (covariance_) covariance_->Close();
    // Only now it is known from when on the run was lost.
    WriteTextFile(folder_.flags(), FlagsCsv(Flags(), written_ns_), IfExists::kReplace);
    std::vector<CloudPoint> points;
    odometry_.map().finest().ForEachPoint([&](const Eigen::Vector3d& p) {
      points.push_back({p.cast<float>(), 0.0F});
    });
    WritePointCloud(folder_.map(), points, CloudFields::kXyz, IfExists::kReplace);
    summary_->map_points = points.size();
    if (view_) WriteViewPly(folder_.view(), view_->Deskew(odometry_.trajectory()));
  }

  /// Fills in what is known by now.
  void Summarise() const {
    RunSummary& s = *summary_;
    s.read = recording_->report();
    s.points = odometry_.point_counts();
    s.times = odometry_.time_report();
    s.lost_at_ns = odometry_.lost_at_ns();
    s.poses_written = sampler_.written();
    s.warnings = s.times.remarks;
    const std::string odd_stamps = s.OddStamps();
    if (!odd_stamps.empty()) {
      s.warnings.push_back("of " + std::to_string(s.times.scans) + " scans: " + odd_stamps);
    }
    s.warnings.insert(s.warnings.end(), s.read.warnings.begin(), s.read.warnings.end());
    if (sampler_.scans_without_pose() > 0) {
      s.warnings.push_back(std::to_string(sampler_.scans_without_pose()) +
                           " scans have no pose: repeated, out of order, or without points");
    }
    const std::vector<ControlPose>& poses = odometry_.trajectory().poses();
    if (!poses.empty()) {
      s.begin_ns = poses.front().t_ns;
      s.end_ns = poses.back().t_ns;
      s.distance_to_start_m = (poses.back().T_world_body.t - poses.front().T_world_body.t).norm();
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i == 0) continue;
      s.path_length_m += (poses[i].T_world_body.t - poses[i - 1].T_world_body.t).norm();
    }
    s.flags = Flags();
    for (const std::string& warning : FlagWarnings(s)) s.warnings.push_back(warning);
    s.estimation_s = 1e-3 * processing_.total_ms();
    if (s.end_ns) {
      const ProcessingTime::Quantiles quantiles = processing_.PerSecondOfData(*s.end_ns);
      s.median_ms = quantiles.median_ms;
      s.p95_ms = quantiles.p95_ms;
    }
  }

 private:
  /// The time counts for the data that was used last.
  template <typename Work>
  void Timed(const Work& work) {
    const Clock::time_point begin = Clock::now();
    work();
    if (first_ns_) processing_.Add(newest_ns_, 1e3 * SecondsSince(begin));
  }

  void Append(std::int64_t t_ns, const SE3& T_world_body) {
    trajectory_.Append(t_ns, T_world_body);
    written_ns_.push_back(t_ns);
  }

  PoseFlags Flags() const { return {odometry_.trajectory().poses(), odometry_.lost_at_ns()}; }

  const RunRequest& request_;
  const ResultFolder& folder_;
  ScanSource* recording_;
  RunSummary* summary_;
  TrajectorySampler sampler_;
  TumWriter trajectory_;
  WindowCsvWriter windows_;
  std::optional<CovarianceCsvWriter> covariance_;
  std::optional<ScanSampler> view_;
  Odometry odometry_;
  ProcessingTime processing_;
  std::optional<std::int64_t> first_ns_;  ///< Stamps of the scans that were used.
  std::int64_t newest_ns_ = 0;
  std::vector<std::int64_t> written_ns_;  ///< Times of the poses in the trajectory file.
  double inlier_share_ = 0.0;
};

void End(ExitCode code, const char* reason, const std::string& message, RunSummary* summary) {
  summary->exit_code = static_cast<int>(code);
  summary->exit_reason = reason;
  summary->message = message;
}

/// The outcome of a run that came to its end; what is worse wins.
void JudgeOutcome(bool interrupted, RunSummary* s) {
  if (interrupted) {
    End(ExitCode::kInterrupted, "interrupted", "a signal ended the run early", s);
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
  } else if (const std::string missing = s->MissingInput(); !missing.empty()) {
    End(ExitCode::kPartialInput, "partial_input", missing + "; the warnings say more", s);
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
    run.Estimate(stop);
  } catch (const OutputError&) {
    run.Summarise();
    throw;
  } catch (const std::exception& error) {
    failure = FailureText(error);
  }
  run.Write();
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
  if (!request.quiet) std::fputs(SummaryTable(summary).c_str(), stdout);
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
    Execute(request, folder, recording.get(), stop, &summary);
  } catch (const OutputError& error) {
    End(ExitCode::kOutputNotWritable, "output_not_writable", error.what(), &summary);
  } catch (const InputError& error) {
    End(ExitCode::kInputUnreadable, "input_unreadable", error.what(), &summary);
  } catch (const std::exception& error) {
    End(ExitCode::kFailed, "failed", FailureText(error), &summary);
  }
  summary.wall_s = SecondsSince(begin);
  summary.cpu_s = ProcessCpuSeconds();
  summary.peak_memory_mb = PeakMemoryMegabytes();
  if (!prepared) {
    std::fprintf(stderr, "trajlo_run: %s\n", summary.message.c_str());
    return static_cast<ExitCode>(*summary.exit_code);
  }
  try {
    WriteRunJson(folder.summary(), summary);
  } catch (const OutputError& error) {
    std::fprintf(stderr, "trajlo_run: %s\n", error.what());
    summary.exit_code = static_cast<int>(ExitCode::kOutputNotWritable);
  }
  Print(request, summary);
  return static_cast<ExitCode>(*summary.exit_code);
}

}  // namespace trajlo
