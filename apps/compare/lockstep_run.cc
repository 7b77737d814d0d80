// SPDX-License-Identifier: MIT
#include "apps/compare/lockstep_run.h"

#include "core/comparison/forms/ceres_form_solver.h"
#include "core/comparison/lockstep_csv.h"
#include "core/odometry/odometry.h"

namespace trajlo {

std::vector<LockstepTotals> RunLockstep(const CompareRequest& request,
                                        const std::vector<SolverVariant>& variants,
                                        const std::atomic<bool>& stop, Feed* feed) {
  std::vector<LockstepTotals> totals(variants.size());
  LockstepCsvWriter csv(request.output, variants);
  const auto note = [&](const LockstepRecord& record) {
    csv.Append(record);
    totals[record.variant].Add(record);
  };
  Odometry odometry(request.config.odometry,
                    MakeLockstepFactory(variants, request.lockstep_options,
                                        MakeSolverFactory(request.config.ceres_form), note));
  double inlier_share = 0.0;
  odometry.OnWindow([&](const WindowStatistics& window) { inlier_share = window.InlierShare(); });
  *feed = FeedRecording(request, "lockstep", stop, inlier_share, &odometry);
  csv.Close();
  return totals;
}

}  // namespace trajlo
