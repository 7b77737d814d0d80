// SPDX-License-Identifier: MIT
// How bodies gain and lose speed: the pace itself, and the motions that follow it.
#include "core/simulation/motions/pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/simulation/scenario.h"
#include "core/simulation/scenes/scene_builder.h"

namespace trajlo::simulation {
namespace {

using Eigen::Vector3d;

/// The gentle ramp of the kind, which an acceleration replaces.
constexpr double kUnusedRamp = 99.0;

/// 30 m/s at 3 m/s², 5 s at that speed, brakes with 7 m/s²: 10.6 s + 5 s + 4.9 s, then 2 s of rest.
MotionConfig HurriedDriver() {
  MotionConfig config;
  config.kind = "drive";
  config.shake = 0.0;
  config.unevenness = 0.0;
  config.speed_mps = 30.0;
  config.acceleration_mps2 = 3.0;
  config.cruise_s = 5.0;
  config.braking_mps2 = 7.0;
  return config;
}

double Speed(const MotionConfig& config, double t_s) {
  return config.speed_mps * Pace(config, t_s, kUnusedRamp);
}

Vector3d Velocity(const PoseFunction& pose, double t, double h = 1e-3) {
  return (pose(t + h).t - pose(t - h).t) / (2.0 * h);
}

Vector3d Acceleration(const PoseFunction& pose, double t, double h = 1e-3) {
  return (pose(t + h).t - 2.0 * pose(t).t + pose(t - h).t) / (h * h);
}

PoseFunction MotionOf(const Scenario& scenario) {
  return MakeMotion(scenario.motion, BuildScene(scenario.scene, scenario.seed).routes,
                    scenario.duration_s, scenario.seed);
}

TEST(Pace, KeepsToTheAccelerationsAndTheTopSpeed) {
  const MotionConfig config = HurriedDriver();
  constexpr double kH = 1e-4;
  double top = 0.0;
  double largest = 0.0;
  double smallest = 0.0;
  double jerk = 0.0;
  for (double t = kH; t < 24.0; t += 0.01) {
    top = std::max(top, Speed(config, t));
    const double slope = (Speed(config, t + kH) - Speed(config, t - kH)) / (2.0 * kH);
    largest = std::max(largest, slope);
    smallest = std::min(smallest, slope);
    jerk = std::max(
        jerk, std::abs(Speed(config, t + kH) - 2.0 * Speed(config, t) + Speed(config, t - kH)) /
                  (kH * kH));
  }
  EXPECT_NEAR(top, 30.0, 1e-9);
  EXPECT_NEAR(largest, 3.0, 1e-6);
  EXPECT_NEAR(smallest, -7.0, 1e-6);
  EXPECT_LT(jerk, 7.0 / 0.6 * 2.2);  // The steepest slope of the smooth step is 35/16.
}

TEST(Pace, RestsExactlyBeforeTheStartAndBetweenStops) {
  const MotionConfig config = HurriedDriver();
  const double stands_at = config.rest_s + 10.6 + 5.0 + 30.0 / 7.0 + 0.6;
  EXPECT_EQ(Pace(config, config.rest_s, kUnusedRamp), 0.0);
  EXPECT_EQ(Pace(config, stands_at + 0.1, kUnusedRamp), 0.0);
  EXPECT_EQ(Pace(config, stands_at + 1.9, kUnusedRamp), 0.0);
  // Then everything comes again.
  EXPECT_NEAR(Pace(config, stands_at + 2.0 + 3.0, kUnusedRamp),
              Pace(config, config.rest_s + 3.0, kUnusedRamp), 1e-12);
}

TEST(Pace, AMovingStartCruisesFirst) {
  MotionConfig config = HurriedDriver();
  config.moving_start = true;
  EXPECT_NEAR(Pace(config, -1.0, kUnusedRamp), 1.0, 1e-12);
  EXPECT_NEAR(Pace(config, 4.9, kUnusedRamp), 1.0, 1e-12);
  EXPECT_LT(Pace(config, 7.0, kUnusedRamp), 0.8);
}

TEST(Pace, WithoutStopsItKeepsItsSpeed) {
  MotionConfig config = HurriedDriver();
  config.cruise_s = 0.0;
  EXPECT_NEAR(Pace(config, 500.0, kUnusedRamp), 1.0, 1e-12);
}

TEST(Pace, StopsNeedAnAccelerationAndADeceleration) {
  const SceneRoutes routes = BuildScene("motorway", 1).routes;
  MotionConfig config = HurriedDriver();
  config.acceleration_mps2 = 0.0;
  EXPECT_THROW(MakeMotion(config, routes, 30.0, 1), std::invalid_argument);
  config = HurriedDriver();
  config.braking_mps2 = 0.0;
  EXPECT_THROW(MakeMotion(config, routes, 30.0, 1), std::invalid_argument);
  config = HurriedDriver();
  config.acceleration_mps2 = -3.0;
  EXPECT_THROW(MakeMotion(config, routes, 30.0, 1), std::invalid_argument);
}

TEST(Pace, ACarDrivesToThirtyMetresPerSecondAndBrakesToRest) {
  const MotionConfig config = HurriedDriver();
  const PoseFunction pose = MakeMotion(config, BuildScene("motorway", 1).routes, 25.0, 1);
  EXPECT_LT((pose(config.rest_s).t - pose(0.0).t).norm(), 1e-13);
  double top = 0.0;
  double distance = 0.0;
  double full_acceleration_s = 0.0;
  constexpr double kStep = 0.01;
  double stand_s = 0.0;
  for (double t = kStep; t < 24.9; t += kStep) {
    const double speed = Velocity(pose, t).norm();
    const Vector3d acceleration = Acceleration(pose, t);
    top = std::max(top, speed);
    distance += speed * kStep;
    EXPECT_LT(acceleration.x(), 3.0 + 0.05) << t;
    EXPECT_GT(acceleration.x(), -7.0 - 0.05) << t;
    if (acceleration.x() > 2.95) full_acceleration_s += kStep;
    if (t > config.rest_s && speed < 1e-6) stand_s += kStep;
  }
  EXPECT_NEAR(top, 30.0, 0.01);
  EXPECT_GT(full_acceleration_s, 8.0);
  EXPECT_GT(stand_s, 0.4);
  // The area under the speed: trapezoids whose flanks are as long as the change and its onset.
  const double expected = 30.0 * (0.5 * 10.6 + 5.0 + 0.5 * (30.0 / 7.0 + 0.6));
  EXPECT_NEAR((pose(24.9).t - pose(0.0).t).norm(), expected, 0.5);
  EXPECT_NEAR(distance, expected, 0.5);
}

TEST(Pace, ADriverBrakesBeforeBendsAndSpeedsUpAfterThem) {
  MotionConfig config = HurriedDriver();
  config.speed_mps = 14.0;
  config.cruise_s = 0.0;
  const PoseFunction pose = MakeMotion(config, BuildScene("street", 1).routes, 60.0, 1);
  double top = 0.0;
  double turned = 0.0;
  double heading = 0.0;
  for (double t = 0.01; t < 59.0; t += 0.01) {
    const Vector3d velocity = Velocity(pose, t);
    const Vector3d acceleration = Acceleration(pose, t);
    top = std::max(top, velocity.norm());
    EXPECT_LT(acceleration.norm(), 5.0) << t;
    if (velocity.norm() < 0.1) continue;
    const double next = std::atan2(velocity.y(), velocity.x());
    turned += std::abs(std::remainder(next - heading, 2.0 * M_PI));
    heading = next;
  }
  EXPECT_NEAR(top, 14.0, 0.1);
  EXPECT_GT(turned, 2.0 * M_PI);  // All round the block.
}

class FromRest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenarios, FromRest,
                         testing::Values("motorway_start_hdl64", "motorway_start_os1_128",
                                         "motorway_jam_hdl64", "street_start_hdl64",
                                         "street_stop_and_go_hdl64", "manhattan_start_hdl32"),
                         [](const auto& instance) { return instance.param; });

TEST_P(FromRest, StartsAtRestReachesItsSpeedAndStopsWithinTheRecording) {
  const Scenario scenario = MakeScenario(GetParam());
  const MotionConfig& config = scenario.motion;
  const PoseFunction pose = MotionOf(scenario);
  double top = 0.0;
  bool stopped = false;
  for (double t = 0.01; t < scenario.duration_s; t += 0.01) {
    const double speed = Velocity(pose, t).norm();
    if (t < config.rest_s - 0.01) {
      EXPECT_LT(speed, 1e-9) << t;
    }
    top = std::max(top, speed);
    stopped = stopped || (top > 0.5 * config.speed_mps && speed < 0.1);
    EXPECT_LT(Acceleration(pose, t, 0.05).norm(), config.braking_mps2 + 1.5) << t;
  }
  EXPECT_NEAR(top, config.speed_mps, 0.05 * config.speed_mps);
  EXPECT_TRUE(stopped);
}

TEST(Pace, AFastFlightKeepsToItsAcceleration) {
  Scenario scenario = MakeScenario("facade_fast_os1_16");
  scenario.motion.shake = 0.0;
  const PoseFunction pose = MotionOf(scenario);
  double top = 0.0;
  for (double t = 0.01; t < scenario.duration_s; t += 0.01) {
    top = std::max(top, Velocity(pose, t).norm());
    EXPECT_LT(Acceleration(pose, t).head<2>().norm(), 4.0) << t;
  }
  EXPECT_GT(top, 8.0);
}

TEST(Pace, AHoveringRobotRisesSlowlyAndStandsInTheAir) {
  for (const char* name : {"atrium_hover_os1_16", "tall_room_os1_16"}) {
    Scenario scenario = MakeScenario(name);
    scenario.motion.shake = 0.0;
    const PoseFunction pose = MotionOf(scenario);
    double fastest = 0.0;
    double hovering_s = 0.0;
    for (double t = 0.01; t < scenario.duration_s; t += 0.01) {
      const Vector3d velocity = Velocity(pose, t);
      fastest = std::max(fastest, std::abs(velocity.z()));
      if (pose(t).t.z() > 3.0 && velocity.norm() < 1e-3) hovering_s += 0.01;
    }
    EXPECT_LT(fastest, 1.0) << name;
    EXPECT_GT(fastest, 0.3) << name;
    EXPECT_GT(hovering_s, 10.0) << name;
  }
}

}  // namespace
}  // namespace trajlo::simulation
