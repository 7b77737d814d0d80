// SPDX-License-Identifier: MIT
#include "apps/compare/free_run.h"

#include <algorithm>
#include <filesystem>

#include "core/comparison/forms/ceres_form_solver.h"
#include "core/io/trajectory_writer.h"
#include "core/odometry/odometry.h"
#include "core/report/processing_time.h"
#include "core/report/resource_usage.h"
#include "core/report/window_csv.h"

namespace trajlo {
namespace {

/// Two trajectories part where they are farther apart.
constexpr double kSame_m = 1e-6;

}  // namespace

FreeResult RunFree(const CompareRequest& request, const SolverVariant& variant,
                   const std::atomic<bool>& stop) {
  FreeResult result;
  result.name = variant.name;
  const std::filesystem::path folder =
      std::filesystem::path(request.output) / "free" / variant.name;
  std::filesystem::create_directories(folder);
  WindowCsvWriter windows(folder / "windows.csv", IfExists::kReplace);

  const double cpu_begin_s = ProcessCpuSeconds();
  Odometry odometry(variant.odometry, MakeSolverFactory(variant.ceres_form));
  double inlier_share = 0.0;
  std::vector<double> solve_ms;
  odometry.OnWindow([&](const WindowStatistics& window) {
    windows.Append(window);
    result.windows.Add(window);
    result.rejected_steps += window.rejected_steps;
    solve_ms.push_back(window.milliseconds_solve);
    inlier_share = window.InlierShare();
  });
  result.feed = FeedRecording(request, variant.name, stop, inlier_share, &odometry);
  result.cpu_s = ProcessCpuSeconds() - cpu_begin_s;
  result.median_solve_ms = Quantile(std::move(solve_ms), 0.5);

  TumWriter trajectory(folder / "trajectory.tum", IfExists::kReplace);
  for (const ControlPose& pose : odometry.trajectory().poses()) {
    trajectory.Append(pose.t_ns, pose.T_world_body);
    result.poses.push_back({pose.t_ns, pose.T_world_body});
  }
  trajectory.Close();
  windows.Close();
  return result;
}

void CompareWithFirst(const FreeResult& first, FreeResult* result) {
  auto other = first.poses.begin();
  for (const StampedPose& pose : result->poses) {
    while (other != first.poses.end() && other->t_ns < pose.t_ns) ++other;
    if (other == first.poses.end()) return;
    if (other->t_ns != pose.t_ns) continue;  // Another segment length has poses at other times.
    ++result->poses_compared;
    const double distance_m = (other->T_world_body.t - pose.T_world_body.t).norm();
    result->max_from_first_m = std::max(result->max_from_first_m, distance_m);
    if (distance_m > kSame_m && !result->parts_at_ns) result->parts_at_ns = pose.t_ns;
  }
}

}  // namespace trajlo
