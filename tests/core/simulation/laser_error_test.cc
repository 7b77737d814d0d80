// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/laser_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/simulation/simulator.h"
#include "tests/core/simulation/hollow_cube.h"

namespace trajlo::simulation {
namespace {

using Eigen::Vector3d;

SE3 SteadyMotion(double t_s) {
  Vector6d twist;
  twist << 2.0, 0.5, 0.1, 0.2, 0.1, 1.5;
  return se3::Exp(t_s * twist);
}

TEST(ImperfectLaser, EveryOneIsWrongInItsOwnWayThroughoutARecording) {
  Scenario scenario;
  scenario.rig = {MakeLidar("os1_16", SE3(so3::Exp({0.1, -0.2, 0.4}), {0.2, -0.1, 0.3}))};
  scenario.duration_s = 0.2;
  MeasurementModel& model = scenario.rig[0].measurement;
  model.range_sigma_m = 0.0;
  model.dropout_fraction = 0.0;
  model.laser_range_sigma_m = 0.02;
  model.laser_angle_sigma_rad = 2e-3;
  const Simulator simulator(scenario, MakeHollowCube(), SteadyMotion);
  SensorModel sensor = MakeSensor("os1_16");
  sensor.measurement = model;
  const std::vector<LaserError> errors = DrawLaserErrors(sensor, scenario.seed, 0);
  ASSERT_EQ(errors.size(), 16U);
  double ranges = 0.0, angles = 0.0;
  for (const LaserError& error : errors) {
    ranges += error.range_m * error.range_m / 16.0;
    angles += (error.up_rad * error.up_rad + error.left_rad * error.left_rad) / 32.0;
  }
  EXPECT_NEAR(std::sqrt(ranges), 0.02, 0.01);
  EXPECT_NEAR(std::sqrt(angles), 2e-3, 1e-3);

  for (const int index : {0, 1}) {
    const SimulatedScan scan = simulator.SimulateScan(0, index);
    ASSERT_EQ(scan.scan.points.size(), 16U * 1024U);
    for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
      const LidarPoint& point = scan.scan.points[i];
      const Vector3d nominal = sensor.pattern->At(0, static_cast<int>(i)).direction;
      const LaserError& error = errors[i % 16];
      const SE3 T = simulator.TrueWorldFromBody(point.t_ns) * scenario.rig[0].T_body_lidar;
      const double range_m =
          CubeRange(T.t, T.q * Turned(nominal, error.up_rad, error.left_rad)) + error.range_m;
      ASSERT_LT((point.xyz_m.cast<double>() - range_m * nominal).norm(), 1e-5) << i;
    }
  }
  const std::vector<LaserError> of_another_lidar = DrawLaserErrors(sensor, scenario.seed, 1);
  EXPECT_NE(of_another_lidar[3].range_m, errors[3].range_m);
}

TEST(ImperfectLaser, TurnsUpAndToTheLeftAsTheSensorHasThem) {
  const Vector3d forward = Vector3d::UnitX();
  EXPECT_EQ(Turned(forward, 0.0, 0.0), forward);
  EXPECT_LT((Turned(forward, 1e-3, 0.0) - Vector3d(1.0, 0.0, 1e-3)).norm(), 1e-6);
  EXPECT_LT((Turned(forward, 0.0, 1e-3) - Vector3d(1.0, 1e-3, 0.0)).norm(), 1e-6);
  EXPECT_NEAR(Turned(Vector3d::UnitZ(), 1e-3, 0.0).z(), 1.0, 1e-6) << "where left is anywhere";
}

// A board before a wall, once 0.2 m and once 2 m: where a beam lights both, what it tells lies in
// between, or on one of them.
TEST(ImperfectLaser, ABeamThatLightsTwoSurfacesMixesThemIfTheyAreNear) {
  const auto count_between = [](double gap_m, double divergence_rad) {
    TriangleMesh mesh;
    mesh.AddBox(Vector3d::Constant(-5.0), Vector3d::Constant(5.0), 0.5);
    const double x = 5.0 - gap_m;
    mesh.AddQuad({x, -1.0, -1.0}, {x, 1.0, -1.0}, {x, 1.0, 1.0}, {x, -1.0, 1.0}, 0.5);
    Scenario scenario;
    scenario.duration_s = 0.1;
    scenario.rig = {MakeLidar("os0_64")};
    scenario.rig[0].measurement.range_sigma_m = 0.0;
    scenario.rig[0].measurement.dropout_fraction = 0.0;
    scenario.rig[0].measurement.divergence_rad = divergence_rad;
    const Simulator simulator(scenario, Scene(std::move(mesh)), [](double) { return SE3(); });
    const SimulatedScan scan = simulator.SimulateScan(0, 0);
    EXPECT_EQ(scan.scan.points.size(), 64U * 1024U);
    int between = 0;
    for (const LidarPoint& point : scan.scan.points) {
      const Eigen::Vector3f& p = point.xyz_m;
      const bool is_before_wall = std::abs(p.y()) < 2.0F && std::abs(p.z()) < 2.0F;
      const double from_board_m = static_cast<double>(p.x()) - x;
      between += is_before_wall && from_board_m > 0.03 && from_board_m < gap_m - 0.03 ? 1 : 0;
    }
    return between;
  };
  EXPECT_EQ(count_between(0.2, 0.0), 0);
  EXPECT_GT(count_between(0.2, 0.02), 10);
  EXPECT_EQ(count_between(2.0, 0.02), 0);
}

}  // namespace
}  // namespace trajlo::simulation
