// SPDX-License-Identifier: MIT
#include "core/simulation/motions/motion.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "core/simulation/motions/smooth.h"
#include "core/simulation/scenes/scene_builder.h"
#include "tests/support/temp_folder.h"

namespace trajlo::simulation {
namespace {

constexpr double kDuration = 12.0;

SceneRoutes Routes(const std::string& scene = "hall") { return BuildScene(scene, 1).routes; }

Eigen::Vector3d Acceleration(const PoseFunction& pose, double t, double h) {
  return (pose(t + h).t - 2.0 * pose(t).t + pose(t - h).t) / (h * h);
}

/// In the body frame, at t.
Eigen::Vector3d AngularVelocity(const PoseFunction& pose, double t, double h) {
  return so3::Log(pose(t - h).q.conjugate() * pose(t + h).q) / (2.0 * h);
}

Eigen::Vector3d AngularAcceleration(const PoseFunction& pose, double t, double h) {
  return (AngularVelocity(pose, t + h, h) - AngularVelocity(pose, t - h, h)) / (2.0 * h);
}

struct Steps {
  double linear = 0.0;   // The largest change of the acceleration from sample to sample, m/s².
  double angular = 0.0;  // The same for rad/s².
};

/// Where an acceleration is continuous, its steps shrink with the spacing of the samples.
Steps LargestSteps(const PoseFunction& pose, double h) {
  Steps steps;
  Eigen::Vector3d linear = Acceleration(pose, 0.5, h);
  Eigen::Vector3d angular = AngularAcceleration(pose, 0.5, h);
  for (double t = 0.5 + h; t < kDuration - 0.5; t += h) {
    const Eigen::Vector3d next_linear = Acceleration(pose, t, h);
    const Eigen::Vector3d next_angular = AngularAcceleration(pose, t, h);
    steps.linear = std::max(steps.linear, (next_linear - linear).norm());
    steps.angular = std::max(steps.angular, (next_angular - angular).norm());
    linear = next_linear;
    angular = next_angular;
  }
  return steps;
}

struct MotionCase {
  const char* kind;
  const char* scene;
  bool moving_start;
  bool stops = false;
};
std::ostream& operator<<(std::ostream& out, const MotionCase& c) { return out << c.kind; }

class AnyMotion : public ::testing::TestWithParam<MotionCase> {
 protected:
  static PoseFunction Make() {
    MotionConfig config;
    config.kind = GetParam().kind;
    config.moving_start = GetParam().moving_start;
    config.landing = std::string(GetParam().kind) == "flight";
    config.speed_mps = std::string(GetParam().kind) == "drive" ? 10.0 : 1.5;
    if (GetParam().stops) {
      config.acceleration_mps2 = 2.0;
      config.cruise_s = 2.0;
      config.braking_mps2 = 4.0;
      config.stop_s = 1.0;
    }
    if (std::string(GetParam().kind) == "twist") config.turn_rate_rad_s = 0.5;
    return MakeMotion(config, Routes(GetParam().scene), kDuration, 3);
  }
};
INSTANTIATE_TEST_SUITE_P(
    Kinds, AnyMotion,
    ::testing::Values(MotionCase{"walk", "office", false}, MotionCase{"walk", "stairwell", true},
                      MotionCase{"flight", "hall", false}, MotionCase{"flight", "facade", true},
                      MotionCase{"drive", "street", false}, MotionCase{"drive", "manhattan", true},
                      MotionCase{"walk", "office", false, true},
                      MotionCase{"flight", "tall_room", false, true},
                      MotionCase{"drive", "street", false, true},
                      MotionCase{"drive", "motorway", true, true},
                      MotionCase{"bursts", "hall", false}, MotionCase{"glances", "office", false},
                      MotionCase{"glances", "corridor", true},
                      MotionCase{"spin", "courtyard", false}, MotionCase{"spin", "courtyard", true},
                      MotionCase{"swing", "hall", false}, MotionCase{"twist", "hall", false},
                      MotionCase{"twist", "hall", true}, MotionCase{"still", "hall", false}),
    [](const auto& instance) {
      return std::string(instance.param.kind) + "_" + instance.param.scene +
             (instance.param.moving_start ? "_moving" : "_resting") +
             (instance.param.stops ? "_stopping" : "");
    });

TEST_P(AnyMotion, HasContinuousAccelerations) {
  const PoseFunction pose = Make();
  const Steps coarse = LargestSteps(pose, 4e-3);
  const Steps fine = LargestSteps(pose, 1e-3);
  // A jump would stay what it is; a continuous acceleration's steps become a quarter.
  EXPECT_LT(fine.linear, 0.4 * coarse.linear + 1e-6);
  EXPECT_LT(fine.angular, 0.4 * coarse.angular + 1e-6);
}

TEST_P(AnyMotion, RestsExactlyOrMovesFromTheStart) {
  const PoseFunction pose = Make();
  if (std::string(GetParam().kind) == "still") return;
  const SE3 first = pose(0.0);
  if (GetParam().moving_start) {
    EXPECT_GT(Minus(pose(0.1), first).norm(), 0.01);
    return;
  }
  for (double t = 0.1; t <= 1.8; t += 0.1) {
    EXPECT_LT(Minus(pose(t), first).norm(), 1e-13) << t;
  }
  EXPECT_GT(Minus(pose(5.0), first).norm(), 0.1);
}

TEST_P(AnyMotion, HasUnitQuaternions) {
  const PoseFunction pose = Make();
  for (double t = 0.0; t < kDuration; t += 0.37) EXPECT_NEAR(pose(t).q.norm(), 1.0, 1e-12);
}

TEST(Smooth, TheFastSineIsTheSine) {
  for (double x = -2000.0; x < 2000.0; x += 0.0137) ASSERT_NEAR(FastSine(x), std::sin(x), 2e-13);
}

TEST(Smooth, TheIntegralOfTheStepHasItAsItsDerivative) {
  constexpr double kH = 1e-5;
  for (double x = -0.5; x < 1.5; x += 0.01) {
    const double slope = (SmoothStepIntegral(x + kH) - SmoothStepIntegral(x - kH)) / (2.0 * kH);
    EXPECT_NEAR(slope, SmoothStep(x), 1e-8);
  }
}

TEST(Motion, APlatformSpinsBeyondTheRangeOfAnImu) {
  MotionConfig config;
  config.kind = "spin";
  config.turn_rate_rad_s = 35.0;
  const PoseFunction pose = MakeMotion(config, Routes("courtyard"), 10.0, 1);
  EXPECT_NEAR(AngularVelocity(pose, 8.0, 1e-4).norm(), 35.0, 1.0);
}

TEST(Motion, ARopeSwingsBeyondThreeG) {
  MotionConfig config;
  config.kind = "swing";
  const PoseFunction pose = MakeMotion(config, Routes(), 12.0, 1);
  double largest = 0.0;
  for (double t = 6.0; t < 12.0; t += 0.01) {
    const Eigen::Vector3d gravity(0.0, 0.0, 9.81);
    largest = std::max(largest, (Acceleration(pose, t, 1e-3) + gravity).norm());
  }
  EXPECT_GT(largest, 3.0 * 9.81);
}

TEST(Motion, AGlanceTurnsAndTurnsBackQuickly) {
  MotionConfig config;
  config.kind = "glances";
  config.burst_deg = 90.0;
  config.shake = 0.0;
  const PoseFunction glances = MakeMotion(config, Routes("corridor"), 20.0, 1);
  config.kind = "walk";
  const PoseFunction walk = MakeMotion(config, Routes("corridor"), 20.0, 1);
  double largest = 0.0;
  double fastest = 0.0;
  double straight_s = 0.0;
  for (double t = 4.0; t < 20.0; t += 0.01) {
    const Eigen::Vector3d turn = so3::Log(walk(t).q.conjugate() * glances(t).q);
    EXPECT_LT(turn.head<2>().norm(), 1e-9);
    EXPECT_LT((walk(t).t - glances(t).t).norm(), 2.0 * 0.12 + 1e-9);
    largest = std::max(largest, std::abs(turn.z()));
    fastest = std::max(fastest, AngularVelocity(glances, t, 1e-3).norm());
    if (turn.norm() == 0.0) straight_s += 0.01;
  }
  EXPECT_GT(largest, 70.0 * M_PI / 180.0);
  EXPECT_LE(largest, 90.0 * M_PI / 180.0 + 1e-9);
  // A smooth step of 90 degrees within 0.4 s, at its steepest.
  EXPECT_GT(fastest, 0.75 * (35.0 / 16.0) * 0.5 * M_PI / 0.4);
  EXPECT_GT(straight_s, 4.0);
}

TEST(Motion, AConstantTwistIsOne) {
  MotionConfig config;
  config.kind = "twist";
  config.moving_start = true;
  config.shake = 0.0;
  config.speed_mps = 2.0;
  config.turn_rate_rad_s = 0.7;
  const PoseFunction pose = MakeMotion(config, Routes(), 12.0, 1);
  Vector6d expected;
  expected << 2.0, 0.0, 0.0, 0.0, 0.0, 0.7;
  for (double t = 0.0; t < 10.0; t += 0.7) {
    EXPECT_LT((Minus(pose(t + 0.1), pose(t)) / 0.1 - expected).norm(), 1e-9);
  }
}

TEST(Motion, ALandingEndsOnTheGround) {
  MotionConfig config;
  config.kind = "flight";
  config.landing = true;
  const PoseFunction pose = MakeMotion(config, Routes(), 25.0, 1);
  EXPECT_NEAR(pose(0.0).t.z(), 0.3, 1e-6);
  EXPECT_GT(pose(12.0).t.z(), 2.0);
  EXPECT_NEAR(pose(25.0).t.z(), 0.3, 1e-6);
  EXPECT_LT(Minus(pose(25.0), pose(24.5)).norm(), 1e-13);
}

TEST(Motion, AFlightMayBeHigherThanItsRoute) {
  MotionConfig config;
  config.kind = "flight";
  config.shake = 0.0;
  const PoseFunction usual = MakeMotion(config, Routes(), 25.0, 1);
  config.raised_m = 50.0;
  const PoseFunction raised = MakeMotion(config, Routes(), 25.0, 1);
  EXPECT_NEAR(raised(0.0).t.z(), 0.3, 1e-6);
  for (double t = 8.0; t < 25.0; t += 1.7) {
    EXPECT_LT((raised(t).t - usual(t).t - Eigen::Vector3d(0.0, 0.0, 50.0)).norm(), 1e-9) << t;
  }
}

TEST(Motion, AFlightKeepsToItsTilt) {
  MotionConfig config;
  config.kind = "flight";
  config.shake = 0.0;
  config.speed_mps = 6.0;
  const PoseFunction pose = MakeMotion(config, Routes(), 20.0, 1);
  for (double t = 0.0; t < 20.0; t += 0.05) {
    const double tilt = std::acos((pose(t).q * Eigen::Vector3d::UnitZ()).z());
    // Roll and pitch may add up.
    EXPECT_LT(tilt * 180.0 / M_PI, 15.0 * std::sqrt(2.0) + 0.1);
  }
}

class Replay : public ::testing::Test {
 protected:
  void Write(const std::string& text) const { std::ofstream(path_) << text; }
  PoseFunction Make(bool placed, double duration_s = 1.9) const {
    MotionConfig config;
    config.kind = "replay";
    config.replay_file = path_;
    config.replay_placed = placed;
    return MakeMotion(config, Routes(), duration_s, 1);
  }
  trajlo::testing::TempFolder folder_;
  const std::string path_ = folder_ / "replay.tum";
};

TEST_F(Replay, PassesThroughTheGivenPosesSmoothly) {
  std::string text = "# t x y z qx qy qz qw\n";
  std::vector<SE3> poses;
  for (int i = 0; i < 20; ++i) {
    const double a = 0.15 * i;
    poses.push_back(
        {so3::Exp({0.1 * a, 0.2 * std::sin(a), a}), {std::sin(a), std::cos(a), 0.1 * a}});
    const SE3& T = poses.back();
    // Every other quaternion with the other sign: it is the same rotation.
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    char line[256];
    std::snprintf(line, sizeof(line), "%.9f %.15g %.15g %.15g %.15g %.15g %.15g %.15g\n",
                  1000.0 + 0.1 * i, T.t.x(), T.t.y(), T.t.z(), sign * T.q.x(), sign * T.q.y(),
                  sign * T.q.z(), sign * T.q.w());
    text += line;
  }
  Write(text);
  const PoseFunction pose = Make(false);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT(Minus(pose(0.1 * static_cast<double>(i)), poses[i]).norm(), 1e-6) << i;
  }
  const double step = (Acceleration(pose, 1.0001, 1e-4) - Acceleration(pose, 0.9999, 1e-4)).norm();
  EXPECT_LT(step, 1e-2);

  // Placed in the hall, it starts where the flights do, and moves as in the file.
  const PoseFunction placed = Make(true);
  EXPECT_NEAR(placed(0.0).t.head<2>().x(), Routes().fly.points.front().x(), 1e-9);
  EXPECT_LT((Minus(placed(1.0), placed(0.0)) - Minus(pose(1.0), pose(0.0))).norm(), 1e-9);
}

TEST_F(Replay, SaysWhichLineIsWrong) {
  const std::pair<const char*, const char*> mistakes[] = {{"1 0 0 0 0 0 zero 1\n", "line 2"},
                                                          {"1 nan 0 0 0 0 0 1\n", "line 2"},
                                                          {"1 0 0 0 0 0 0 0\n", "line 2"},
                                                          {"1 0 0 0", "line 2"},
                                                          {"0 0 0 0 0 0 0 1\n", "0.000000000 s"}};
  for (const auto& [line, place] : mistakes) {
    Write(std::string("0 0 0 0 0 0 0 1\n") + line);
    try {
      Make(false, 0.5);
      ADD_FAILURE() << line;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(place), std::string::npos) << error.what();
    }
  }
}

TEST_F(Replay, SaysWhatDurationTheFileAllows) {
  Write("0 0 0 0 0 0 0 1\n1.2345678 0 0 0 0 0 0 1\n");
  EXPECT_NO_THROW(Make(false, 1.234));
  try {
    Make(false, 15.0);
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("duration_s of at most 1.234"), std::string::npos)
        << error.what();
  }
}

TEST_F(Replay, TimesSince1970AreAsExactAsOthers) {
  std::string early, late;
  for (int i = 0; i < 30; ++i) {
    char line[160];
    std::snprintf(line, sizeof(line), "%02d.%03d %d 0 0 0 0 0 1\n", i / 10, 100 * (i % 10), i * i);
    early += std::string("000000") + line;
    late += std::string("17000000") + line;
  }
  Write(early);
  const PoseFunction exact = Make(false);
  Write(late);
  const PoseFunction same = Make(false);
  for (double t = 0.0; t < 1.9; t += 0.013) EXPECT_EQ(same(t).t.x(), exact(t).t.x()) << t;
}

TEST_F(Replay, RefusesAFileThatIsShorterThanTheRecording) {
  Write("0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
  EXPECT_THROW(Make(false, 2.0), std::runtime_error);
  EXPECT_NO_THROW(Make(false, 1.0));
}

TEST(MakeMotion, RefusesBurstsAndGlancesThatNeverEnd) {
  MotionConfig config;
  config.kind = "glances";
  config.glance_s = 0.0;
  EXPECT_THROW(MakeMotion(config, Routes(), 1.0, 1), std::invalid_argument);
  config.kind = "bursts";
  config.burst_every_s = 0.0;
  EXPECT_THROW(MakeMotion(config, Routes(), 1.0, 1), std::invalid_argument);
}

TEST(MakeMotion, RefusesAnUnknownKind) {
  MotionConfig config;
  config.kind = "jump";
  EXPECT_THROW(MakeMotion(config, Routes(), 1.0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace trajlo::simulation
