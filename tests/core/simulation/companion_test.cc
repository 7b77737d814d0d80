// SPDX-License-Identifier: MIT
#include "core/simulation/companion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/simulation/scenes/scene.h"
#include "core/simulation/simulator.h"
#include "tests/core/simulation/hollow_cube.h"

namespace trajlo::simulation {
namespace {

using Eigen::Vector3d;

SE3 Motion(double t_s) {
  return {so3::Exp({0.1 * std::sin(t_s), 0.2, 0.5 * t_s}), {2.0 * t_s, -t_s, 1.3}};
}

/// Nothing, and a companion of a body that moves so.
Scene OnlyWith(const CompanionConfig& config) {
  return Scene(TriangleMesh{}, {MakeCompanion(config, Motion)});
}

TEST(Companion, ATruckIsSeenAtTheSamePlaceWhereverTheBodyGoes) {
  CompanionConfig config;
  config.kind = "truck";
  config.ahead_m = 0.0;
  config.left_m = 4.0;
  config.below_m = 1.5;
  const Scene scene = OnlyWith(config);
  for (const double t_s : {0.0, 1.7, 30.0}) {
    const SE3 T = Motion(t_s);
    const double yaw = std::atan2((T.q * Vector3d::UnitX()).y(), (T.q * Vector3d::UnitX()).x());
    const Vector3d left(-std::sin(yaw), std::cos(yaw), 0.0);
    const auto hit = scene.CastRay(T.t, left, t_s, 100.0);
    ASSERT_TRUE(hit) << t_s;
    EXPECT_NEAR(hit->range_m, 4.0 - 1.25, 1e-4);
    EXPECT_FALSE(scene.CastRay(T.t, -left, t_s, 100.0));
    EXPECT_FALSE(scene.CastRay(T.t, Vector3d::UnitZ(), t_s, 100.0));
  }
}

TEST(Companion, ARoofTiltsWithTheBody) {
  CompanionConfig config;
  config.kind = "roof";
  config.ahead_m = 0.0;
  config.below_m = 0.4;
  const Scene scene = OnlyWith(config);
  for (const double t_s : {0.0, 1.7}) {
    const SE3 T = Motion(t_s);
    const auto hit = scene.CastRay(T.t, T.q * -Vector3d::UnitZ(), t_s, 100.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, 0.4, 1e-5);
  }
}

TEST(Companion, APersonSwaysAsFarAsAsked) {
  CompanionConfig config;
  config.kind = "person";
  config.ahead_m = 1.5;
  config.sway_m = 0.1;
  const MovingObject person = MakeCompanion(config, [](double) { return SE3(); });
  double least = 10.0, most = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d t = person.T_world_object(1e-3 * i).t;
    least = std::min(least, t.x());
    most = std::max(most, t.x());
    EXPECT_EQ(t.z(), -1.3);
  }
  EXPECT_NEAR(least, 1.4, 1e-3);
  EXPECT_NEAR(most, 1.6, 1e-3);
}

TEST(Clutter, ReplacesAsManyReturnsAsAskedByNearerOnes) {
  Scenario scenario;
  scenario.rig = {MakeLidar("os1_16")};
  scenario.duration_s = 1.0;
  MeasurementModel& model = scenario.rig[0].measurement;
  model.range_sigma_m = 0.0;
  model.dropout_fraction = 0.0;
  model.min_range_m = 0.0;
  model.clutter_fraction = 0.2;
  model.clutter_range_m = 2.0;
  const Simulator simulator(scenario, MakeHollowCube(), [](double) { return SE3(); });
  int points = 0, nearer = 0;
  double expected = 0.0;
  for (const int index : {0, 3, 7}) {
    for (const LidarPoint& point : simulator.SimulateScan(0, index).scan.points) {
      const Vector3d p = point.xyz_m.cast<double>();
      const double wall_m = CubeRange(Vector3d::Zero(), p.normalized());
      ++points;
      if (p.norm() < wall_m - 1e-3) ++nearer;
      expected += 0.2 * (1.0 - std::exp(-wall_m / 2.0));
    }
  }
  ASSERT_EQ(points, 3 * 16 * 1024);
  EXPECT_NEAR(nearer / expected, 1.0, 0.05);
}

TEST(Clutter, IsNoFartherThanTheSensorSees) {
  Scenario scenario;
  scenario.rig = {MakeLidar("os1_16")};
  scenario.duration_s = 1.0;
  MeasurementModel& model = scenario.rig[0].measurement;
  model.range_sigma_m = 0.0;
  model.max_range_m = 1.0;  // The walls are farther.
  model.clutter_fraction = 1.0;
  model.clutter_range_m = 10.0;
  const Simulator simulator(scenario, MakeHollowCube(), [](double) { return SE3(); });
  const SimulatedScan scan = simulator.SimulateScan(0, 0);
  EXPECT_GT(scan.scan.points.size(), 100u);
  for (const LidarPoint& point : scan.scan.points) EXPECT_LT(point.xyz_m.norm(), 1.0F + 1e-5F);
}

}  // namespace
}  // namespace trajlo::simulation
