// SPDX-License-Identifier: MIT
#include "apps/compare/lockstep_run.h"

#include <cstdio>
#include <utility>

#include "core/comparison/lockstep_csv.h"
#include "core/io/recording/open_recording.h"
#include "core/odometry/odometry.h"
#include "core/odometry/stopwatch.h"
#include "core/report/progress_bar.h"

namespace trajlo {

std::vector<LockstepTotals> RunLockstep(const CompareRequest& request,
                                        const std::vector<SolverVariant>& variants) {
  std::vector<LockstepTotals> totals(variants.size());
  LockstepCsvWriter csv(request.output, variants);
  LockstepSolver* lockstep = nullptr;
  Odometry odometry(
      request.config.odometry, [&](const SolverOptions& options, ThreadPool* threads) {
        auto solver = std::make_unique<LockstepSolver>(variants, request.lockstep_options,
                                                       MakeWindowSolver(options, threads), threads,
                                                       [&](const LockstepRecord& record) {
                                                         csv.Append(record);
                                                         totals[record.variant].Add(record);
                                                       });
        lockstep = solver.get();
        return solver;
      });
  double inlier_share = 0.0;
  odometry.OnWindow([&](const WindowStatistics& window) {
    inlier_share = window.InlierShare();
    lockstep->FinishWindow();
  });
  const auto recording = OpenRecording(request.inputs, request.config.input);
  ProgressBar bar(stderr, request.quiet);
  Stopwatch watch;
  double wall_s = 0.0;
  std::int64_t first_ns = 0;
  LidarScan scan;
  for (std::size_t count = 0; recording->Next(&scan); ++count) {
    if (count == 0) first_ns = scan.stamp_ns;
    odometry.AddScan(scan);
    wall_s += watch.Seconds();
    bar.Update({count + 1, recording->size(), 1e-9 * static_cast<double>(scan.stamp_ns - first_ns),
                wall_s, inlier_share});
  }
  odometry.Finish();
  csv.Close();
  return totals;
}

}  // namespace trajlo
