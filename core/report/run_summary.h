// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/io/scan_source.h"
#include "core/odometry/segments/segment_cloud.h"
#include "core/report/pose_flags.h"
#include "core/report/rig_report.h"
#include "core/report/window_totals.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/time_report.h"

namespace trajlo {

/// All that is said about a run when it is over, in run.json and in the table on the screen.
struct RunSummary {
  // How it ended. The reason is one word: running (or killed), ok, partial_input, ...
  std::optional<int> exit_code;  ///< Nothing until it has ended.
  std::string exit_reason = "running";
  std::string message;
  std::vector<std::string> warnings;

  // What was asked.
  std::vector<std::string> command_line;
  std::vector<std::string> inputs;
  std::string output;
  std::string solver;
  int threads = 0;

  // What was read. The description says how stamps and point times are understood, and why.
  std::vector<std::string> input_description;
  ReadReport read;
  PointCounts points;
  TimeReport times;

  // What came out.
  WindowTotals windows;
  bool too_short = false;  ///< There are poses, and no window has confirmed them.
  std::size_t poses_written = 0;
  PoseFlags flags;
  std::size_t map_points = 0;
  std::vector<LidarPlace> rig;  ///< As found.
  std::optional<std::int64_t> begin_ns, end_ns, lost_at_ns;
  double path_length_m = 0.0;
  double distance_to_start_m = 0.0;

  // What it took. Only these numbers differ between two equal runs.
  double wall_s = 0.0;        ///< Reading, estimating and writing.
  double cpu_s = 0.0;         ///< The same, over all threads.
  double estimation_s = 0.0;  ///< Wall time of the estimator alone.
  double median_ms = 0.0;     ///< Estimation per second of data.
  double p95_ms = 0.0;
  double peak_memory_mb = 0.0;

  /// Fills in when the poses begin and end, and how long the way is.
  void TakePoses(const std::vector<ControlPose>& poses);

  /// Points that are not finite in the recording. Those without a possible time come as such
  /// points, too, and are counted by ReadReport.
  std::int64_t NotFinite() const;
  /// The share of the points that were dropped because of their times.
  double ShareWithWrongTimes() const;
  /// What became of scans with odd stamps, and of how many: "3 put in order, 1 dropped (...)";
  /// empty if there were none.
  std::string OddStamps() const;
  /// Why the result cannot be relied on as a whole (exit code 3); empty if it can. Damage counts.
  /// Points count if more than 5 % were dropped because of their times, scans if more than 5 %
  /// have other times than their stamps or, unlike the others, one time for all points, if more
  /// than 5 % have or seem to have the points of others, if the first or the last 5 % have no
  /// points, or if a last scan that was dropped would lengthen the recording by more than 5 %.
  /// Pauses count if they take more than 5 % of the time, flags if they take more than 95 %, poses
  /// that jump or have been in doubt since, or that a lone object holds, if they take more than a
  /// quarter, a body at rest whose points cannot have been seen from one place (SightLines), and a
  /// direction that points leave open if they do so for more than five seconds on end, or for two
  /// thirds of the time. So do a LiDAR that contradicts its extrinsic, or is silent for more than 5
  /// % of the time at either end or throughout, clocks that may differ, and a recording that is too
  /// short for a window.
  std::string Shortcomings() const;

  double DataSeconds() const { return begin_ns && end_ns ? Seconds(*end_ns - *begin_ns) : 0.0; }
  double RealTimeFactor() const { return wall_s > 0.0 ? DataSeconds() / wall_s : 0.0; }

 private:
  bool IsSizeable(std::int64_t scans) const;
  std::string OutOfRange() const;
  void AddDamage(std::vector<std::string>* parts) const;
  void AddOddTimes(std::vector<std::string>* parts) const;
  void AddUnseenEnds(std::vector<std::string>* parts) const;
  void AddWeakTrajectory(std::vector<std::string>* parts) const;
};

}  // namespace trajlo
