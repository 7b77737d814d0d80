// SPDX-License-Identifier: MIT
#include "core/odometry/window/registration_evaluator.h"

#include <gtest/gtest.h>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using Equations = std::vector<RegistrationNormalEquations>;

Equations Evaluate(RegistrationEvaluator evaluator, const std::vector<SE3>& poses, bool jacobians,
                   Window* window) {
  Equations equations;
  evaluator.Evaluate(window, poses, jacobians, &equations);
  return equations;
}

/// The poses of a window with the one at `k` moved along x.
std::vector<SE3> Moved(const Window& window, std::size_t k, double x_m) {
  std::vector<SE3> poses = window.Poses();
  Vector6d tau = Vector6d::Zero();
  tau[0] = x_m;
  poses[k] = Plus(poses[k], tau);
  return poses;
}

class RegistrationReuse : public ::testing::Test {
 protected:
  RegistrationReuse() : threads_(1), exact_(&threads_), reusing_(&threads_, {1e-3, 1e-4}) {}

  ThreadPool threads_;
  RegistrationEvaluator exact_, reusing_;
};

TEST_F(RegistrationReuse, ShiftsWhatHardlyMovedAndEvaluatesTheRest) {
  Window window = testing::MakeTestWindow(3);
  Evaluate(reusing_, window.Poses(), true, &window);
  // The last pose belongs to the last segment alone.
  const std::vector<SE3> poses = Moved(window, 4, 0.01);
  const Equations truth = Evaluate(exact_, poses, true, &window);
  window = testing::MakeTestWindow(3);
  Evaluate(reusing_, window.Poses(), true, &window);
  for (Segment& segment : window.segments) segment.points.resize(1);  // To be noticed.
  const Equations reused = Evaluate(reusing_, poses, true, &window);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(reused[k].H, truth[k].H) << k;
  EXPECT_NE(reused[3].H, truth[3].H);
}

TEST_F(RegistrationReuse, IsExactToFirstOrder) {
  for (const bool jacobians : {false, true}) {
    Window window = testing::MakeTestWindow(4);
    // Without a kernel the cost is quadratic but for the curvature of rotations.
    window.noise.kernel.kind = KernelKind::kNone;
    Evaluate(reusing_, window.Poses(), true, &window);
    const std::vector<SE3> poses = Moved(window, 2, 0.9e-3);
    const Equations reused = Evaluate(reusing_, poses, jacobians, &window);
    const Equations truth = Evaluate(exact_, poses, true, &window);
    for (std::size_t k = 0; k < truth.size(); ++k) {
      EXPECT_NEAR(reused[k].cost, truth[k].cost, 1e-6 * truth[k].cost);
      EXPECT_LT((reused[k].g - truth[k].g).norm(), 1e-4 * truth[k].H.norm() * 0.9e-3);
    }
  }
}

TEST_F(RegistrationReuse, ManyShortStepsMakeALongOne) {
  Window window = testing::MakeTestWindow(5);
  Evaluate(reusing_, window.Poses(), true, &window);
  const Matrix12d before = window.segments[3].linearization->equations.H;
  Evaluate(reusing_, Moved(window, 4, 0.6e-3), true, &window);
  EXPECT_EQ(window.segments[3].linearization->equations.H, before);
  Evaluate(reusing_, Moved(window, 4, 1.2e-3), true, &window);
  EXPECT_NE(window.segments[3].linearization->equations.H, before);
}

}  // namespace
}  // namespace trajlo
