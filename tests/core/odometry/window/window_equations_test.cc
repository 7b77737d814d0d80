// SPDX-License-Identifier: MIT
#include "core/odometry/window/window_equations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "core/odometry/solvers/window_solver.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

/// The equations of a window of many segments, each registered.
WindowNormalEquations LongEquations() {
  Window window = testing::MakeTestWindow(3, 60, 40);
  ThreadPool threads(1);
  SolverOptions options;
  options.kind = SolverKind::kGaussNewton;
  MakeWindowSolver(options, &threads)->Solve(&window);
  return AssembleWindow(window);
}

TEST(WindowEquations, ALongWindowIsSolvedAsADenseOneWouldBe) {
  const WindowNormalEquations equations = LongEquations();
  const Eigen::VectorXd expected = -equations.H.ldlt().solve(equations.g);
  const Eigen::VectorXd xi = SolveNormalEquations(equations);
  ASSERT_EQ(xi.size(), 6 * 41);
  EXPECT_LT((xi - expected).norm(), 1e-9 * expected.norm());
}

TEST(WindowEquations, NothingIsFiniteWhereALongWindowIsSingular) {
  WindowNormalEquations equations = LongEquations();
  equations.H.row(30).setZero();
  equations.H.col(30).setZero();
  EXPECT_FALSE(SolveNormalEquations(equations).allFinite());
}

}  // namespace
}  // namespace trajlo
