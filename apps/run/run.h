// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/run/run_request.h"
#include "core/io/scan_source.h"
#include "core/io/trajectory_writer.h"
#include "core/odometry/odometry.h"
#include "core/report/covariance_csv.h"
#include "core/report/pose_flags.h"
#include "core/report/processing_time.h"
#include "core/report/result_folder.h"
#include "core/report/run_summary.h"
#include "core/report/scan_sampler.h"
#include "core/report/trajectory_sampler.h"
#include "core/report/window_csv.h"

namespace trajlo {

/// One run from the first scan to the last file. The summary belongs to the caller, who needs it
/// when a member throws: OutputError where a file cannot be written, and what the reader throws.
class Run {
 public:
  /// All arguments must outlive it.
  Run(const RunRequest& request, const ResultFolder& folder, ScanSource* recording,
      RunSummary* summary);

  /// Feeds the estimator; returns early when `stop` is set.
  void Estimate(const std::atomic<bool>& stop);
  /// Completes the files that grew and writes those that did not.
  void Write();
  /// Fills in what is known by now.
  void Summarise() const;

 private:
  using Clock = std::chrono::steady_clock;

  /// The time counts for the data that was used last.
  template <typename Work>
  void Timed(const Work& work);
  void Append(std::int64_t t_ns, const SE3& T_world_body);
  void WriteRig() const;
  std::vector<LidarPlace> Rig() const;
  PoseFlags Flags() const;

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

}  // namespace trajlo
