// SPDX-License-Identifier: MIT
#include "core/odometry/weights/motion_prior.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <variant>
#include <vector>

#include "core/odometry/solvers/window_solver.h"
#include "tests/support/test_window.h"

namespace trajlo {
namespace {

/// A body on a line that is measured once a segment: how well a MotionPrior follows it.
///
/// The filter is the exact one for white-noise acceleration of density q (pose and velocity, one
/// axis), so what the test sees is the prior's choice of q and nothing else.
struct Line {
  MotionPrior prior;
  double dt_s = 0.03;
  double sigma_m = 0.005;       ///< Of the measurements, as the filter assumes it.
  double true_sigma_m = 0.005;  ///< As it is.
  testing::Random random{7};
  Eigen::Vector2d state = Eigen::Vector2d::Zero();  ///< Position and velocity.
  Eigen::Matrix2d P = Eigen::Vector2d(1e-6, 1.0).asDiagonal();

  explicit Line(const MotionPriorOptions& options) : prior(options) {}

  /// Takes one measurement; the error of the filtered velocity.
  double Step(double true_position_m, double true_velocity_m_s) {
    Eigen::Matrix2d F;
    F << 1, dt_s, 0, 1;
    Eigen::Matrix2d Q;
    Q << dt_s * dt_s * dt_s / 3, dt_s * dt_s / 2, dt_s * dt_s / 2, dt_s;
    state = F * state;
    P = F * P * F.transpose() + prior.density()[0] * Q;
    const double S = P(0, 0) + sigma_m * sigma_m;
    const Eigen::Vector2d K = P.col(0) / S;
    const double nu = true_position_m + random.Gaussian(true_sigma_m) - state[0];
    state += K * nu;
    Innovation innovation;
    innovation.correction.setZero();
    innovation.expected_variance.setZero();
    innovation.gain.setZero();
    innovation.correction[0] = K[0] * nu;
    innovation.expected_variance[0] = K[0] * P(0, 0);
    innovation.gain[0] = K[0];
    P -= K * P.row(0);
    prior.Learn(innovation, dt_s);
    return state[1] - true_velocity_m_s;
  }
};

TEST(MotionPrior, FallsToItsFloorAtRest) {
  Line line({});
  Innovation jolt;
  jolt.correction.setConstant(10.0);
  jolt.expected_variance.setOnes();
  jolt.gain.setOnes();
  line.prior.Follow(jolt);
  ASSERT_GT(line.prior.density()[0], 10.0 * MotionPriorOptions().translation_m2_s3);
  for (int i = 0; i < 200; ++i) line.Step(0.0, 0.0);
  EXPECT_DOUBLE_EQ(line.prior.density()[0], MotionPriorOptions().translation_m2_s3);
}

TEST(MotionPrior, FollowsWhatItDidNotForesee) {
  MotionPrior prior({});
  Innovation turn;
  turn.gain << 1, 1, 1, 1, 1, 1;
  turn.expected_variance.setOnes();
  turn.correction << 0.5, 0, 0, 0, 0, 30;
  prior.Follow(turn);
  // The mean square of (0, 0, 30) is 300; the translation is within what was foreseen.
  EXPECT_DOUBLE_EQ(prior.density()[0], MotionPriorOptions().translation_m2_s3);
  EXPECT_DOUBLE_EQ(prior.density()[5], 300.0 * MotionPriorOptions().rotation_rad2_s3);
  // Foretold now, it is no surprise any more.
  turn.expected_variance.tail<3>() *= 300.0;
  prior.Follow(turn);
  EXPECT_DOUBLE_EQ(prior.density()[5], 300.0 * MotionPriorOptions().rotation_rad2_s3);

  MotionPriorOptions fixed;
  fixed.self_tuning = false;
  MotionPrior stays(fixed);
  turn.expected_variance.setOnes();
  stays.Follow(turn);
  EXPECT_DOUBLE_EQ(stays.density()[5], fixed.rotation_rad2_s3);
}

TEST(MotionPrior, RotationAloneIsUntied) {
  Window window = testing::MakeTestWindow(3);
  const MotionPrior prior({});
  prior.Apply(&window);
  const auto sqrt_information = [&] {
    return std::get<WhiteNoiseAccelerationTerm>(window.segments[1].motion).sqrt_information;
  };
  const Vector6d tied = sqrt_information();
  prior.UntieRotation(&window);
  const Vector6d untied = sqrt_information();
  EXPECT_EQ(untied.head<3>(), tied.head<3>());
  EXPECT_LT(untied.tail<3>().maxCoeff(), 0.01 * tied.tail<3>().minCoeff());
}

TEST(MotionPrior, BendIsHowFarWhiteAccelerationStraysFromAConstantVelocity) {
  MotionPriorOptions options;
  options.translation_m2_s3 = 40.0;
  constexpr double kDuration_s = 0.05;
  constexpr int kSteps = 100, kTrials = 4000;
  constexpr double dt_s = kDuration_s / kSteps;
  testing::Random random(11);
  double sum_m2 = 0.0;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> x_m = {0.0};
    double v_m_s = random.Gaussian(1.0);
    for (int i = 0; i < kSteps; ++i) {
      const double dv_m_s = random.Gaussian(std::sqrt(options.translation_m2_s3 * dt_s));
      x_m.push_back(x_m.back() + dt_s * (v_m_s + dv_m_s / 2));
      v_m_s += dv_m_s;
    }
    for (int i = 0; i < kSteps; ++i) {
      const double off_m = x_m[static_cast<std::size_t>(i)] - x_m.back() * i / kSteps;
      sum_m2 += off_m * off_m / (kSteps * kTrials);
    }
  }
  SegmentCloud cloud;
  cloud.end_ns = static_cast<std::int64_t>(kDuration_s * 1e9);
  const double expected_m2 = MotionPrior(options).Bend_m2(cloud);
  EXPECT_NEAR(sum_m2, expected_m2, 0.05 * expected_m2);
  // A scan at one instant has no way to bend, and the paper's prior knows of none.
  options.kind = MotionPriorKind::kPseudoVelocity;
  EXPECT_EQ(MotionPrior(options).Bend_m2(cloud), 0.0);
  options.kind = MotionPriorKind::kWhiteNoiseAcceleration;
  cloud.is_instant = true;
  EXPECT_EQ(MotionPrior(options).Bend_m2(cloud), 0.0);
}

/// The car that the paper's prior loses: 3 m/s² for ten seconds, after ten seconds of rest.
TEST(MotionPrior, FollowsABodyThatKeepsAccelerating) {
  Line line({});
  double worst = 0.0;
  for (int i = 0; i < 666; ++i) {
    const double t = std::max(0.0, 0.03 * i - 10.0);
    const double error = line.Step(1.5 * t * t, 3.0 * t);
    if (t > 1.0) worst = std::max(worst, std::abs(error));
  }
  EXPECT_LT(worst, 0.6);
  EXPECT_GT(line.prior.density()[0], MotionPriorOptions().translation_m2_s3);
}

TEST(MotionPrior, IsLooseWithinAFewSegmentsOfAJerk) {
  Line line({});
  for (int i = 0; i < 100; ++i) line.Step(0.0, 0.0);
  const double calm = line.prior.density()[0];
  for (int i = 1; i <= 5; ++i) {
    const double t = 0.03 * i;
    line.Step(20.0 * t * t, 40.0 * t);
  }
  EXPECT_GT(line.prior.density()[0], 10.0 * calm);
}

/// Where the acceleration is white, the density is found, from below and after a jolt from above.
TEST(MotionPrior, FindsTheDensityOfWhiteAcceleration) {
  for (const bool begins_with_jolt : {false, true}) {
    MotionPriorOptions options;
    options.translation_m2_s3 = 0.3;
    Line line(options);
    const double q = 8.0;
    if (begins_with_jolt) {
      for (int i = 1; i <= 40; ++i) line.Step(0.5 * (i % 2), 0.0);
      ASSERT_GT(line.prior.density()[0], 100.0 * q);
    }
    double position = 0.0, velocity = 0.0, mean_log = 0.0;
    int counted = 0;
    for (int i = 0; i < 4000; ++i) {
      for (int fine = 0; fine < 10; ++fine) {
        position += 0.003 * velocity;
        velocity += line.random.Gaussian(std::sqrt(q * 0.003));
      }
      line.Step(position, velocity);
      if (i < 200) continue;
      mean_log += std::log(line.prior.density()[0]);
      ++counted;
    }
    const double found = std::exp(mean_log / counted);
    EXPECT_GT(found, q / 4.0) << begins_with_jolt;
    EXPECT_LT(found, q * 4.0) << begins_with_jolt;
  }
}

/// Whiteness has no scale: where noise is 0.5 of what is assumed, the density that weighs motion
/// against points as it should is four times the true one. Judged by the assumed noise, it is found
/// too small, and the estimate lags.
TEST(MotionPrior, IsNotStiffWherePointsHaveLessNoiseThanAssumed) {
  double error[2] = {0.0, 0.0};
  MotionPriorOptions options;
  for (const bool self_tuning : {false, true}) {
    const double q = 2.0;
    options.self_tuning = self_tuning;
    options.translation_m2_s3 = self_tuning ? 0.3 : 4.0 * q;
    Line line(options);
    line.true_sigma_m = 0.5 * line.sigma_m;
    double position = 0.0, velocity = 0.0;
    for (int i = 0; i < 4000; ++i) {
      for (int fine = 0; fine < 10; ++fine) {
        position += 0.003 * velocity;
        velocity += line.random.Gaussian(std::sqrt(q * 0.003));
      }
      line.Step(position, velocity);
      if (i >= 200) error[self_tuning ? 1 : 0] += std::pow(line.state[0] - position, 2) / 3800;
    }
  }
  EXPECT_LT(std::sqrt(error[1] / error[0]), 1.06);
}

/// Errors that change their sign are noise, and no motion: the points weigh less, and the prior
/// stays as stiff as it was.
TEST(MotionPrior, TakesNoiseThatIsLargerThanAssumedForNoise) {
  Line line({});
  line.true_sigma_m = 3.0 * line.sigma_m;
  const double assumed_m = line.sigma_m;
  for (int i = 0; i < 1000; ++i) {
    line.sigma_m = assumed_m * std::sqrt(line.prior.noise_factor());
    line.Step(0.0, 0.0);
  }
  // The prior takes a part of it for motion.
  EXPECT_NEAR(std::sqrt(line.prior.noise_factor()), 2.5, 0.7);
  EXPECT_LT(line.prior.density()[0], 3.0 * MotionPriorOptions().translation_m2_s3);
  // It forgets, too.
  line.true_sigma_m = assumed_m;
  for (int i = 0; i < 300; ++i) {
    line.sigma_m = assumed_m * std::sqrt(line.prior.noise_factor());
    line.Step(0.0, 0.0);
  }
  EXPECT_LT(line.prior.noise_factor(), 1.5);
}

/// An acceleration is no noise.
TEST(MotionPrior, DoesNotTakeAMotionForNoise) {
  Line line({});
  for (int i = 0; i < 300; ++i) {
    const double t = 0.03 * i;
    line.Step(1.5 * t * t, 3.0 * t);
    EXPECT_LT(line.prior.noise_factor(), 2.0) << t;
  }
}

TEST(MotionPrior, LearnsNothingWhereThePointsTellNothing) {
  MotionPrior prior({});
  Innovation innovation;
  innovation.gain.setConstant(0.5);
  innovation.expected_variance.setConstant(4e-6);
  for (int i = 0; i < 100; ++i) {  // Calmer than expected.
    innovation.correction.setConstant(i % 2 == 0 ? 1e-4 : -1e-4);
    prior.Learn(innovation, 0.03);
  }
  const Vector6d before = prior.density();
  const double scale = prior.covariance_scale();
  innovation.correction = Vector6d::Constant(0.1);
  innovation.expected_variance = Vector6d::Zero();
  innovation.gain = Vector6d::Zero();
  for (int i = 0; i < 10; ++i) prior.Learn(innovation, 0.03);
  EXPECT_EQ(prior.density(), before);
  EXPECT_EQ(prior.covariance_scale(), scale);
}

/// The scale after three seconds of corrections whose normalised values are z(i).
double CovarianceScale(const std::function<double(int)>& z) {
  MotionPrior prior({});
  Innovation innovation;
  innovation.expected_variance = Vector6d::Constant(4e-6);
  innovation.gain = Vector6d::Constant(0.5);
  for (int i = 0; i < 100; ++i) {
    innovation.correction = Vector6d::Constant(2e-3 * z(i));
    prior.Learn(innovation, 0.03);
  }
  return prior.covariance_scale();
}

TEST(MotionPrior, TheScaleOfCovariancesIsTheMeanSquareOfCorrections) {
  EXPECT_EQ(MotionPrior({}).covariance_scale(), 1.0);
  EXPECT_NEAR(CovarianceScale([](int) { return 0.0; }), 0.0, 1e-3);
  // The sum in which a lag adds up, and noise that alternates cancels, is for the density alone.
  EXPECT_NEAR(CovarianceScale([](int) { return 0.5; }), 0.25, 0.01);
  EXPECT_NEAR(CovarianceScale([](int i) { return i % 2 == 0 ? 1.0 : -1.0; }), 1.0, 0.01);
}

TEST(MotionPrior, StaysAsItIsWithoutSelfTuning) {
  MotionPriorOptions options;
  options.self_tuning = false;
  Line line(options);
  for (int i = 0; i < 50; ++i) line.Step(0.001 * i * i, 0.0);
  EXPECT_EQ(line.prior.density()[0], options.translation_m2_s3);
}

TEST(MotionPrior, ThePapersPseudoVelocityIsTheVelocityOfTheSegmentBefore) {
  MotionPriorOptions options;
  options.kind = MotionPriorKind::kPseudoVelocity;
  Window window = testing::MakeTestWindow(4);
  MotionPrior(options).Apply(&window);
  for (int k = 1; k < 4; ++k) {
    const auto& term = std::get<SmoothnessTerm>(window.At(k).motion);
    EXPECT_LT((term.tau_expected - 0.03 * window.Velocity(k - 1)).norm(), 1e-12);
    // sigma² = q (2/3) dt³
    EXPECT_NEAR(term.sqrt_information[0], 1.0 / std::sqrt(0.5 * 2.0 / 3.0 * 2.7e-5), 1e-6);
  }
}

/// What is expected of a correction is what the window's own covariances say.
TEST(Innovation, IsLargeWhereThePointsMovedThePoseAndNearZeroWhereThereAreNone) {
  Window window = testing::MakeTestWindow(9);
  ThreadPool threads(1);
  SolverOptions options;
  options.iterations_per_round = 20;
  MakeWindowSolver(options, &threads)->Solve(&window);
  Vector6d moved;
  moved << 0.1, 0, 0, 0, 0, 0.02;
  const SE3 predicted = Plus(window.Poses().back(), -moved);
  const Innovation innovation = MeasureInnovation(window, predicted);
  EXPECT_LT((innovation.correction - moved).norm(), 1e-9);
  EXPECT_GT(innovation.gain.minCoeff(), 0.5);
  EXPECT_LT(innovation.gain.maxCoeff(), 1.0);
  window.segments.back().points.clear();
  window.segments.back().linearization.reset();
  MakeWindowSolver(options, &threads)->Solve(&window);
  EXPECT_LT(MeasureInnovation(window, predicted).gain.maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace trajlo
