// SPDX-License-Identifier: MIT
#include "core/odometry/weights/weight_balance.h"

#include <gtest/gtest.h>

#include "core/odometry/solvers/window_solver.h"
#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using trajlo::testing::Random;

/// Solves windows whose points have independent errors of one configured sigma and whose motion
/// deviates from the expected one by `translation` and `rotation` configured sigmas.
void Feed(double translation, double rotation, int windows, WeightBalance* balance) {
  constexpr double kPointSigma_m = 0.02, kSigma = 0.01;
  ThreadPool threads(1);
  SolverOptions options;
  options.kind = SolverKind::kGaussNewton;
  options.iterations_per_round = 10;
  const auto solver = MakeWindowSolver(options, &threads);
  RegistrationEvaluator evaluator(&threads);
  Random random(5);
  for (int i = 0; i < windows; ++i) {
    WindowProblem problem;
    std::vector<SE3> truth = {random.Pose()};
    std::vector<std::vector<RegistrationPoint>> points(4);
    for (int k = 0; k < 4; ++k) {
      const Vector6d expected = random.Tangent(0.05, 0.1);
      Vector6d tau = expected;
      for (int axis = 0; axis < 3; ++axis) {
        tau[axis] += random.Gaussian(translation * kSigma);
        tau[3 + axis] += random.Gaussian(rotation * kSigma);
      }
      truth.push_back(Plus(truth.back(), tau));
      for (int n = 0; n < 200; ++n) {
        RegistrationPoint point;
        point.p_body_m = random.Uniform(1, 20) * random.Direction();
        point.alpha = random.Uniform(0, 1);
        point.normal_world = random.Direction();
        point.offset_m = point.normal_world.dot(Interpolate(truth[k], truth[k + 1], point.alpha) *
                                                point.p_body_m) +
                         random.Gaussian(kPointSigma_m);
        points[k].push_back(point);
      }
      // As the sliding window does it: the present factor is part of the information.
      SmoothnessTerm term{expected, Vector6d::Constant(1.0 / kSigma)};
      term.sqrt_information.head<3>() /= balance->translation_factor();
      term.sqrt_information.tail<3>() /= balance->rotation_factor();
      problem.smoothness.push_back(term);
    }
    for (const auto& segment : points) problem.points.push_back(&segment);
    problem.poses = truth;
    problem.prior = MakeAnchor(truth[0], 0.001, 0.001);
    problem.noise = {kPointSigma_m, {KernelKind::kNone, 1.0}};
    problem.first_estimate_jacobians = false;
    solver->Solve(&problem);
    std::vector<RegistrationNormalEquations> registration;
    evaluator.Evaluate(problem, problem.poses, true, &registration);
    balance->Update(problem, registration, 0.03);
  }
}

WeightBalanceOptions IndependentPoints() {
  WeightBalanceOptions options;
  options.points_per_error = 1.0;
  options.prior_s = 0.01;
  return options;
}

TEST(WeightBalance, FindsSigmasThatAreTooSmallAndTooLarge) {
  WeightBalance balance(IndependentPoints());
  Feed(3.0, 0.25, 150, &balance);
  EXPECT_NEAR(balance.translation_factor(), 3.0, 0.5);
  EXPECT_NEAR(balance.rotation_factor(), 0.25, 0.06);
}

TEST(WeightBalance, LeavesSigmasThatAreRight) {
  WeightBalance balance(IndependentPoints());
  Feed(1.0, 1.0, 150, &balance);
  EXPECT_NEAR(balance.translation_factor(), 1.0, 0.15);
  EXPECT_NEAR(balance.rotation_factor(), 1.0, 0.15);
}

TEST(WeightBalance, StaysWithinItsBounds) {
  WeightBalanceOptions options = IndependentPoints();
  options.max_factor = 2.0;
  WeightBalance balance(options);
  Feed(50.0, 0.001, 60, &balance);
  EXPECT_EQ(balance.translation_factor(), 2.0);
  EXPECT_EQ(balance.rotation_factor(), 0.5);
}

}  // namespace
}  // namespace trajlo
