// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/window_solver.h"

#include <ceres/covariance.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <gtest/gtest.h>

#include "factors/point_to_plane.h"
#include "manifolds/se3_interpolation.h"
#include "manifolds/se3_manifold.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

using testing::Random;

/// A window of four segments in a room of random planes, started a little off the truth.
struct TestWindow {
  WindowProblem problem;
  std::vector<std::vector<RegistrationPoint>> storage;

  explicit TestWindow(unsigned seed, int points_per_segment = 300) {
    Random random(seed);
    std::vector<SE3> truth = {random.Pose()};
    Vector6d velocity = random.Tangent(0.05, 0.1);
    for (int k = 0; k < 4; ++k) {
      truth.push_back(Plus(truth.back(), velocity + random.Tangent(0.002, 0.003)));
    }
    storage.resize(4);
    for (int k = 0; k < 4; ++k) {
      for (int i = 0; i < points_per_segment; ++i) {
        RegistrationPoint point;
        point.p_body_m = random.Uniform(1, 20) * random.Direction();
        point.alpha = random.Uniform(0, 1);
        point.normal_world = random.Direction();
        const double outlier = random.Uniform(0, 1) < 0.1 ? random.Uniform(-1, 1) : 0.0;
        point.offset_m = point.normal_world.dot(Interpolate(truth[k], truth[k + 1], point.alpha) *
                                                point.p_body_m) +
                         random.Gaussian(0.02) + outlier;
        storage[k].push_back(point);
      }
      problem.smoothness.push_back({velocity, Vector6d::Constant(100.0)});
    }
    for (const auto& points : storage) problem.points.push_back(&points);
    problem.prior = MakeAnchor(Plus(truth[0], random.Tangent(0.001, 0.002)), 0.01, 0.01);
    problem.noise = {0.1, {KernelKind::kCauchy, 2.0}};
    for (const SE3& pose : truth) {
      problem.poses.push_back(Plus(pose, random.Tangent(0.01, 0.03)));
    }
  }
};

double LargestDifference(const std::vector<SE3>& a, const std::vector<SE3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, Minus(a[i], b[i]).cwiseAbs().maxCoeff());
  }
  return largest;
}

SolverOptions Converging(SolverKind kind) {
  SolverOptions options;
  options.kind = kind;
  options.iterations_per_round = 60;
  options.step_tolerance_m = options.step_tolerance_rad = 1e-11;
  options.ceres.function_tolerance = 1e-16;
  options.ceres.parameter_tolerance = 1e-14;
  return options;
}

std::vector<SE3> Solve(const SolverOptions& options, unsigned seed, bool first_estimate = false) {
  ThreadPool threads(2);
  TestWindow window(seed);
  window.problem.first_estimate_jacobians = first_estimate;
  const SolveSummary summary = MakeWindowSolver(options, &threads)->Solve(&window.problem);
  EXPECT_TRUE(summary.finite);
  return window.problem.poses;
}

TEST(WindowSolver, CeresAndGaussNewtonEndAtTheSameOptimum) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto expected = Solve(Converging(SolverKind::kGaussNewton), seed);
    EXPECT_LT(LargestDifference(Solve(Converging(SolverKind::kCeres), seed), expected), 1e-8);
  }
}

TEST(WindowSolver, EveryLinearSolverAndTrustRegionOfCeresEndsThere) {
  const auto expected = Solve(Converging(SolverKind::kGaussNewton), 11);
  for (LinearSolverKind linear :
       {LinearSolverKind::kDenseNormalCholesky, LinearSolverKind::kDenseQr,
        LinearSolverKind::kSparseNormalCholesky, LinearSolverKind::kCgnr}) {
    for (TrustRegionKind region :
         {TrustRegionKind::kLevenbergMarquardt, TrustRegionKind::kDogleg}) {
      if (linear == LinearSolverKind::kCgnr && region == TrustRegionKind::kDogleg) continue;
      SolverOptions options = Converging(SolverKind::kCeres);
      options.ceres.linear_solver = linear;
      options.ceres.trust_region = region;
      EXPECT_LT(LargestDifference(Solve(options, 11), expected), 1e-6)
          << static_cast<int>(linear) << " " << static_cast<int>(region);
    }
  }
}

TEST(WindowSolver, OneCeresIterationIsOneGaussNewtonStep) {
  for (bool first_estimate : {false, true}) {
    SolverOptions options = Converging(SolverKind::kGaussNewton);
    options.iterations_per_round = 1;
    const auto expected = Solve(options, 12, first_estimate);
    options.kind = SolverKind::kCeres;
    EXPECT_LT(LargestDifference(Solve(options, 12, first_estimate), expected), 1e-6);
  }
}

TEST(WindowSolver, EveryFormOfTheRegistrationEndsAtTheSameOptimum) {
  const auto expected = Solve(Converging(SolverKind::kGaussNewton), 13);
  for (RegistrationForm form :
       {RegistrationForm::kPrepared, RegistrationForm::kCondensed, RegistrationForm::kPoint,
        RegistrationForm::kPointAutodiff, RegistrationForm::kSegmentResiduals}) {
    SolverOptions options = Converging(SolverKind::kCeres);
    options.ceres.registration = form;
    // The root of the kernel overshoots far from the optimum: it needs the trust region.
    if (form == RegistrationForm::kSegmentResiduals) {
      options.ceres.initial_trust_region_radius = 1e4;
    }
    EXPECT_LT(LargestDifference(Solve(options, 13), expected), 1e-7) << static_cast<int>(form);
  }
}

TEST(WindowSolver, FirstEstimateJacobiansGiveTheSameStepInEveryAnalyticForm) {
  const auto solve = [](RegistrationForm form) {
    SolverOptions options = Converging(SolverKind::kCeres);
    options.iterations_per_round = 1;
    options.ceres.registration = form;
    return Solve(options, 12, true);
  };
  const auto expected = solve(RegistrationForm::kPrepared);
  EXPECT_LT(LargestDifference(solve(RegistrationForm::kCondensed), expected), 1e-10);
  EXPECT_LT(LargestDifference(solve(RegistrationForm::kPoint), expected), 1e-10);
}

/// Where the state is far from the linearisation point, the cost rises on the last steps to the
/// point where the gradient by first-estimate Jacobians vanishes.
TEST(WindowSolver, WithFirstEstimateJacobiansCeresEndsWhereGaussNewtonEnds) {
  for (RegistrationForm form : {RegistrationForm::kPrepared, RegistrationForm::kCondensed}) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      const auto solve = [&](SolverKind kind, bool first_estimate) {
        TestWindow window(seed);
        Random random(seed);
        SE3& linearized = window.problem.prior.linearization_point;
        linearized = Plus(linearized, random.Tangent(0.01, 0.02));
        window.problem.first_estimate_jacobians = first_estimate;
        SolverOptions options = Converging(kind);
        options.ceres.registration = form;
        ThreadPool threads(1);
        const SolveSummary summary = MakeWindowSolver(options, &threads)->Solve(&window.problem);
        EXPECT_EQ(summary.rejected_steps, 0);
        return window.problem.poses;
      };
      const auto expected = solve(SolverKind::kGaussNewton, true);
      EXPECT_LT(LargestDifference(solve(SolverKind::kCeres, true), expected), 1e-9) << seed;
      EXPECT_GT(LargestDifference(solve(SolverKind::kCeres, false), expected), 1e-7) << seed;
    }
  }
}

TEST(WindowSolver, TheCovarianceOfTheFirstPoseIsThatOfCeres) {
  TestWindow window(16);
  ThreadPool threads(1);
  window.problem.noise.kernel.kind = KernelKind::kNone;
  window.problem.first_estimate_jacobians = false;
  RegistrationEvaluator evaluator(&threads);
  std::vector<RegistrationNormalEquations> registration;
  evaluator.Evaluate(window.problem, window.problem.poses, true, &registration);
  WindowNormalEquations normal;
  AssembleWindow(window.problem, window.problem.poses, registration, &normal);
  const Matrix6d ours = FirstPoseCovariance(normal);

  SE3Manifold manifold;
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(options);
  std::vector<SE3> poses = window.problem.poses;
  for (SE3& pose : poses) problem.AddParameterBlock(pose.data(), 7, &manifold);
  for (int k = 0; k < 4; ++k) {
    problem.AddResidualBlock(new SegmentRegistrationCost(&window.storage[k], window.problem.noise),
                             nullptr, poses[k].data(), poses[k + 1].data());
    problem.AddResidualBlock(new SmoothnessCost(window.problem.smoothness[k]), nullptr,
                             poses[k].data(), poses[k + 1].data());
  }
  problem.AddResidualBlock(new MarginalizationPriorCost(window.problem.prior, false), nullptr,
                           poses[0].data());
  ceres::Covariance covariance({});
  const std::vector<std::pair<const double*, const double*>> wanted = {
      {poses[0].data(), poses[0].data()}};
  ASSERT_TRUE(covariance.Compute(wanted, &problem));
  Eigen::Matrix<double, 6, 6, Eigen::RowMajor> theirs;
  covariance.GetCovarianceBlockInTangentSpace(poses[0].data(), poses[0].data(), theirs.data());
  EXPECT_LT((ours - theirs).norm(), 1e-9 * theirs.norm());
}

TEST(WindowSolver, AWindowThatIsNotHeldHasNoCovariance) {
  WindowNormalEquations normal;
  normal.H = Eigen::MatrixXd::Zero(12, 12);
  normal.H.topLeftCorner<3, 3>().setIdentity();
  EXPECT_TRUE(FirstPoseCovariance(normal).array().isNaN().all());
}

TEST(WindowSolver, ResultsAreTheSameBitsForAnyNumberOfThreads) {
  for (SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    TestWindow one(14, 2000), two(14, 2000);
    ThreadPool one_thread(1), two_threads(2);
    MakeWindowSolver(Converging(kind), &one_thread)->Solve(&one.problem);
    MakeWindowSolver(Converging(kind), &two_threads)->Solve(&two.problem);
    for (std::size_t i = 0; i < one.problem.poses.size(); ++i) {
      EXPECT_EQ(one.problem.poses[i].q.coeffs(), two.problem.poses[i].q.coeffs());
      EXPECT_EQ(one.problem.poses[i].t, two.problem.poses[i].t);
    }
  }
}

TEST(WindowSolver, ASegmentWithoutPointsIsCarriedBySmoothness) {
  for (SolverKind kind : {SolverKind::kGaussNewton, SolverKind::kCeres}) {
    TestWindow window(15);
    ThreadPool threads(1);
    window.storage[3].clear();
    const SolveSummary summary =
        MakeWindowSolver(Converging(kind), &threads)->Solve(&window.problem);
    EXPECT_TRUE(summary.finite);
    EXPECT_LT((Minus(window.problem.poses[4], window.problem.poses[3]) -
               window.problem.smoothness[3].tau_expected)
                  .norm(),
              1e-7);
  }
}

TEST(WindowSolver, MarginalizingTheSolvedWindowBySchurAndByQrIsTheSame) {
  TestWindow window(16);
  ThreadPool threads(1);
  MakeWindowSolver(Converging(SolverKind::kGaussNewton), &threads)->Solve(&window.problem);
  std::vector<RegistrationNormalEquations> registration;
  RegistrationEvaluator(&threads).Evaluate(window.problem, window.problem.poses, true,
                                           &registration);
  const auto schur = MarginalizeOldest(window.problem, registration[0], false);
  const auto qr = MarginalizeOldest(window.problem, registration[0], true);
  EXPECT_TRUE(schur.Information().isApprox(qr.Information(), 1e-8));
  EXPECT_LT((schur.Gradient() - qr.Gradient()).norm(), 1e-6 * (1 + qr.Gradient().norm()));
}

TEST(WindowSolver, TheSmallerWindowWithThePriorHasItsOptimumWhereTheLargerOneHad) {
  TestWindow window(17);
  ThreadPool threads(1);
  WindowProblem& problem = window.problem;
  const SolverOptions options = Converging(SolverKind::kGaussNewton);
  MakeWindowSolver(options, &threads)->Solve(&problem);
  const std::vector<SE3> full = problem.poses;
  std::vector<RegistrationNormalEquations> registration;
  RegistrationEvaluator(&threads).Evaluate(problem, problem.poses, true, &registration);
  problem.prior = MarginalizeOldest(problem, registration[0], false);
  problem.poses.erase(problem.poses.begin());
  problem.points.erase(problem.points.begin());
  problem.smoothness.erase(problem.smoothness.begin());
  MakeWindowSolver(options, &threads)->Solve(&problem);
  EXPECT_LT(LargestDifference(problem.poses, {full.begin() + 1, full.end()}), 1e-8);
}

TEST(WindowCondition, NamesTheDirectionThatNoPlaneHolds) {
  // A corridor along x: all normals are perpendicular to it.
  TestWindow window(18);
  window.problem.first_estimate_jacobians = false;
  for (SE3& pose : window.problem.poses) pose = SE3();
  for (auto& points : window.storage) {
    for (RegistrationPoint& point : points) {
      point.normal_world.x() = 0.0;
      point.normal_world.normalize();
    }
  }
  ThreadPool threads(1);
  std::vector<RegistrationNormalEquations> registration;
  RegistrationEvaluator(&threads).Evaluate(window.problem, window.problem.poses, true,
                                           &registration);
  const WindowCondition condition = ConditionOf(window.problem, registration);
  EXPECT_NEAR(condition.smallest_eigenvalue, 0.0, 1e-9);
  EXPECT_NEAR(std::abs(condition.weak_direction[0]), 1.0, 1e-6);
}

}  // namespace
}  // namespace trajlo
