// SPDX-License-Identifier: MIT
#include "core/comparison/lockstep_solver.h"

#include <gtest/gtest.h>

#include "core/comparison/lockstep_totals.h"
#include "core/odometry/odometry.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

using trajlo::testing::SyntheticWorld;

SolverVariant Variant(const std::string& name, const std::string& settings) {
  RunConfig config;
  ApplyOverrides(settings, &config);
  return {name, settings, config.odometry, config.ceres_form};
}

struct LockstepRun {
  std::vector<LockstepRecord> records;
  int windows = 0;
  std::vector<ControlPose> poses;
};

LockstepRun RunAll(const std::vector<SolverVariant>& variants, int every,
                   const SyntheticWorld& world = {}) {
  LockstepRun run;
  LockstepOptions options;
  options.every = every;
  const auto note = [&](const LockstepRecord& record) { run.records.push_back(record); };
  Odometry odometry({}, MakeLockstepFactory(variants, options, MakeWindowSolver, note));
  odometry.OnWindow([&](const WindowStatistics&) { ++run.windows; });
  for (int i = 0; i < 8; ++i) odometry.AddScan(world.Sweep(i));
  odometry.Finish();
  run.poses = odometry.trajectory().poses();
  return run;
}

TEST(Lockstep, AllSolversOfOneEnergyEndAtTheSamePosesAndCost) {
  const std::vector<SolverVariant> variants = {
      Variant("gauss_newton", "solver.kind=gauss_newton"), Variant("ceres", ""),
      Variant("dogleg", "expert.solver.ceres.trust_region=dogleg"),
      Variant("point", "expert.solver.ceres.registration=point")};
  const LockstepRun run = RunAll(variants, 1);
  ASSERT_GT(run.windows, 5);
  ASSERT_EQ(run.records.size(), 4u * static_cast<std::size_t>(run.windows));
  LockstepTotals ceres;
  for (const LockstepRecord& record : run.records) {
    EXPECT_LT(record.from_first.translation_m, 1e-6) << variants[record.variant].name;
    EXPECT_LT(record.from_first.rotation_rad, 1e-6);
    EXPECT_LE(record.cost_after.Total(), record.cost_before.Total() * (1.0 + 1e-12));
    if (record.variant == 1) ceres.Add(record);
  }
  EXPECT_EQ(ceres.windows(), run.windows);
  EXPECT_GT(ceres.StepsPerWindow(), 0.5);
  EXPECT_LT(ceres.MaxDistance_m(), 1e-6);
}

TEST(Lockstep, EveryStepHasACostAndTheLastIsThatOfTheSolution) {
  const std::vector<SolverVariant> variants = {Variant("gauss_newton", "solver.kind=gauss_newton"),
                                               Variant("ceres", "")};
  for (const LockstepRecord& record : RunAll(variants, 1).records) {
    const SolveSummary& summary = record.summary;
    ASSERT_EQ(summary.costs.size(), static_cast<std::size_t>(summary.iterations + 1))
        << variants[record.variant].name;
    const double after = record.cost_after.Total();
    EXPECT_NEAR(summary.costs.back(), after, 1e-9 * after) << variants[record.variant].name;
  }
}

TEST(Lockstep, TheLastCostIsOfTheKernelThatTheVariantMinimises) {
  const auto records =
      RunAll({Variant("none", "solver.kind=gauss_newton,expert.registration.kernel=none"),
              Variant("none_ceres", "expert.registration.kernel=none")},
             1)
          .records;
  for (std::size_t i = 0; i + 1 < records.size(); i += 2) {
    const double ceres = records[i + 1].summary.costs.back();
    EXPECT_NEAR(records[i].summary.costs.back(), ceres, 1e-6 * ceres);
  }
}

/// What moves at the start is tried by several trackers, with solvers of their own.
TEST(Lockstep, WindowsOfARunThatBeginsInMotionAreComparedOnce) {
  SyntheticWorld world;
  world.T_world_body = [](double t) { return SE3(so3::Exp({0.0, 0.0, 0.5 * t}), {t, 0.0, 0.0}); };
  const LockstepRun run = RunAll({Variant("gauss_newton", "solver.kind=gauss_newton")}, 1, world);
  ASSERT_GT(run.windows, 5);
  ASSERT_EQ(run.records.size(), static_cast<std::size_t>(run.windows));
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    EXPECT_EQ(run.records[i].window, static_cast<int>(i));
  }
}

TEST(Lockstep, OneWindowInWhichTheComputerWasBusyDecidesNothing) {
  LockstepTotals totals;
  LockstepRecord record;
  for (int i = 0; i < 9; ++i) {
    record.total_s = i == 4 ? 1.0 : 0.002;
    record.summary.evaluate_s = 0.5 * record.total_s;
    totals.Add(record);
  }
  EXPECT_DOUBLE_EQ(totals.MedianTotalMs(), 2.0);
  EXPECT_DOUBLE_EQ(totals.MedianEvaluateMs(), 1.0);
  EXPECT_DOUBLE_EQ(totals.MedianLinearSolveMs(), 0.0);
}

TEST(Lockstep, DoesNotChangeTheRunAndComparesEveryNthWindow) {
  const LockstepRun all = RunAll({Variant("gauss_newton", "solver.kind=gauss_newton")}, 1);
  const LockstepRun some = RunAll({Variant("tukey", "expert.registration.kernel=tukey")}, 3);
  EXPECT_EQ(some.records.size(), static_cast<std::size_t>((some.windows + 2) / 3));
  ASSERT_EQ(all.poses.size(), some.poses.size());
  for (std::size_t i = 0; i < all.poses.size(); ++i) {
    EXPECT_EQ(all.poses[i].T_world_body.t, some.poses[i].T_world_body.t);
  }
}

/// Leaves windows as they are.
class IdleSolver final : public WindowSolver {
 public:
  SolveSummary Solve(Window* /*window*/) override { return {}; }
};

TEST(Lockstep, AWindowIsAnotherOneByItsEndWhetherTheOneBeforeWasReportedOrNot) {
  const std::vector<SolverVariant> variants = {Variant("gauss_newton", "solver.kind=gauss_newton")};
  ThreadPool threads(1);
  std::vector<int> compared;
  LockstepSolver solver(variants, {}, std::make_unique<IdleSolver>(), &threads,
                        [&](const LockstepRecord& record) { compared.push_back(record.window); });
  Window window;
  window.segments.resize(1);
  for (const std::int64_t end_ns : {10, 10, 20, 20, 30}) {
    window.segments.back().cloud.end_ns = end_ns;
    solver.Solve(&window);
  }
  EXPECT_EQ(compared, (std::vector<int>{0, 1, 2}));
}

}  // namespace
}  // namespace trajlo
