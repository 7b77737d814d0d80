// SPDX-License-Identifier: MIT
#include "core/simulation/simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/core/simulation/hollow_cube.h"
#include "tests/support/bytes_of.h"

namespace trajlo::simulation {
namespace {

using Eigen::Vector3d;

/// Fast enough that a scan taken as a whole is visibly bent: 2 m/s and 1.5 rad/s.
SE3 FastMotion(double t) {
  Vector6d twist;
  twist << 2.0, 0.5, 0.1, 0.2, 0.1, 1.5;
  return se3::Exp((t - 0.25) * twist);
}

Scenario CubeScenario(const std::string& sensor, double duration_s = 0.5) {
  Scenario scenario;
  scenario.name = "cube";
  const SE3 T_body_lidar(so3::Exp({0.1, -0.2, 0.4}), {0.2, -0.1, 0.3});
  scenario.rig = {MakeLidar(sensor, T_body_lidar)};
  scenario.duration_s = duration_s;
  return scenario;
}

Simulator CubeSimulator(const Scenario& scenario) {
  return {scenario, MakeHollowCube(), FastMotion};
}

double StandardDeviation(const std::vector<double>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double v : values) {
    sum += v;
    squares += v * v;
  }
  const auto n = static_cast<double>(values.size());
  return std::sqrt(squares / n - sum * sum / (n * n));
}

class EverySensor : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Names, EverySensor, ::testing::ValuesIn(SensorNames()),
                         [](const auto& instance) { return instance.param; });

TEST_P(EverySensor, SeesThinPlanesWithTheTruePoseOfEachPointAndBlurredOnesWithOnePosePerScan) {
  const Scenario scenario = CubeScenario(GetParam());
  const Simulator simulator = CubeSimulator(scenario);
  const SE3& T_body_lidar = scenario.rig[0].T_body_lidar;
  const double sigma = scenario.rig[0].measurement.range_sigma_m;
  std::vector<double> range_errors;
  std::vector<double> thickness;
  std::vector<double> blurred;
  SimulateScans(simulator, 0, [&](const SimulatedScan& simulated) {
    const SE3 T_scan = simulator.TrueWorldFromBody(simulated.true_start_ns) * T_body_lidar;
    for (const LidarPoint& point : simulated.scan.points) {
      const SE3 T_world_lidar = simulator.TrueWorldFromBody(point.t_ns) * T_body_lidar;
      const Vector3d p = point.xyz_m.cast<double>();
      const Vector3d ray = T_world_lidar.q * p.normalized();
      range_errors.push_back(p.norm() - CubeRange(T_world_lidar.t, ray));
      thickness.push_back(DistanceToCubeFace(T_world_lidar * p));
      blurred.push_back(DistanceToCubeFace(T_scan * p));
    }
  });
  ASSERT_GT(range_errors.size(), 1000U);
  EXPECT_NEAR(StandardDeviation(range_errors), sigma, 0.03 * sigma);
  EXPECT_LT(StandardDeviation(thickness), 1.01 * sigma);
  EXPECT_GT(StandardDeviation(blurred), 3.0 * sigma);
}

TEST(Simulator, WithoutNoiseEveryPointLiesOnTheSurface) {
  Scenario scenario = CubeScenario("os0_64", 0.2);
  scenario.rig[0].measurement.range_sigma_m = 0.0;
  scenario.rig[0].measurement.dropout_fraction = 0.0;
  const Simulator simulator = CubeSimulator(scenario);
  std::size_t points = 0;
  SimulateScans(simulator, 1, [&](const SimulatedScan& simulated) {
    for (const LidarPoint& point : simulated.scan.points) {
      const Vector3d p = simulator.TrueWorldFromBody(point.t_ns) *
                         (scenario.rig[0].T_body_lidar * point.xyz_m.cast<double>());
      ASSERT_NEAR(DistanceToCubeFace(p), 0.0, 1e-5);
    }
    points += simulated.scan.points.size();
  });
  EXPECT_EQ(points, 2U * 64U * 1024U);
}

std::vector<SimulatedScan> AllScans(const Simulator& simulator, int threads) {
  std::vector<SimulatedScan> scans;
  SimulateScans(simulator, threads, [&](const SimulatedScan& scan) { scans.push_back(scan); });
  return scans;
}

TEST(Simulator, TwoThreadCountsGiveTheSameBytes) {
  Scenario scenario = CubeScenario("os1_16");
  scenario.rig.push_back(MakeLidar("avia"));
  scenario.rig[1].phase_s = 0.037;
  scenario.rig[0].measurement.angle_sigma_rad = 1e-3;
  scenario.faults.nan_point_fraction = 0.01;
  scenario.faults.dropped_scan_fraction = 0.2;
  const Simulator simulator = CubeSimulator(scenario);
  const std::vector<SimulatedScan> one = AllScans(simulator, 1);
  const std::vector<SimulatedScan> many = AllScans(simulator, 4);
  ASSERT_EQ(one.size(), many.size());
  static_assert(sizeof(LidarPoint) == 24, "no padding, so that bytes can be compared");
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].scan.stamp_ns, many[i].scan.stamp_ns);
    ASSERT_EQ(one[i].scan.points.size(), many[i].scan.points.size());
    EXPECT_TRUE(testing::BytesOf(one[i].scan.points.data(), one[i].scan.points.size()) ==
                testing::BytesOf(many[i].scan.points.data(), many[i].scan.points.size()));
  }
}

TEST(Simulator, AnotherSeedGivesOtherNoise) {
  Scenario scenario = CubeScenario("os1_16", 0.1);
  const std::vector<SimulatedScan> a = AllScans(CubeSimulator(scenario), 0);
  scenario.seed = 2;
  const std::vector<SimulatedScan> b = AllScans(CubeSimulator(scenario), 0);
  EXPECT_NE(a[0].scan.points[5].xyz_m, b[0].scan.points[5].xyz_m);
}

TEST(Simulator, DropsTheAskedShareOfReturnsAndThoseOutOfRange) {
  Scenario scenario = CubeScenario("os0_64", 0.1);
  scenario.rig[0].measurement.dropout_fraction = 0.25;
  const std::vector<SimulatedScan> scans = AllScans(CubeSimulator(scenario), 0);
  EXPECT_NEAR(static_cast<double>(scans[0].scan.points.size()) / 65536.0, 0.75, 0.01);

  scenario.rig[0].measurement.min_range_m = 4.0;
  scenario.rig[0].measurement.max_range_m = 6.0;
  scenario.rig[0].measurement.range_sigma_m = 0.0;
  const std::vector<SimulatedScan> near = AllScans(CubeSimulator(scenario), 0);
  for (const LidarPoint& point : near[0].scan.points) {
    EXPECT_GE(point.xyz_m.norm(), 3.999F);
    EXPECT_LE(point.xyz_m.norm(), 6.001F);
  }
}

TEST(Simulator, AngularNoiseMovesTheHitButNotTheReportedDirection) {
  Scenario scenario = CubeScenario("os1_16", 0.1);
  scenario.rig[0].measurement.range_sigma_m = 0.0;
  scenario.rig[0].measurement.dropout_fraction = 0.0;
  scenario.rig[0].measurement.angle_sigma_rad = 2e-3;
  const Simulator simulator = CubeSimulator(scenario);
  const SimulatedScan scan = AllScans(simulator, 0)[0];
  const SensorModel sensor = MakeSensor("os1_16");
  std::vector<double> errors;
  ASSERT_EQ(scan.scan.points.size(), 16U * 1024U);
  for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
    const Vector3d p = scan.scan.points[i].xyz_m.cast<double>();
    const Vector3d nominal = sensor.pattern->At(0, static_cast<int>(i)).direction;
    ASSERT_LT((p.normalized() - nominal).norm(), 1e-6);
    const SE3 T =
        simulator.TrueWorldFromBody(scan.scan.points[i].t_ns) * scenario.rig[0].T_body_lidar;
    errors.push_back(p.norm() - CubeRange(T.t, T.q * nominal));
  }
  EXPECT_GT(StandardDeviation(errors), 2e-3);
  EXPECT_LT(StandardDeviation(errors), 5e-2);
}

TEST(Simulator, PhaseAndClockOffsetMoveSweepAndStamps) {
  Scenario scenario = CubeScenario("os1_16");
  scenario.rig[0].phase_s = 0.03;
  scenario.rig[0].clock_offset_s = 0.005;
  const Simulator simulator = CubeSimulator(scenario);
  EXPECT_EQ(simulator.ScanCount(0), 4);
  const SimulatedScan scan = simulator.SimulateScan(0, 1);
  EXPECT_EQ(scan.true_start_ns, simulator.start_ns() + 130'000'000);
  EXPECT_EQ(scan.scan.stamp_ns, scan.true_start_ns + 5'000'000);
  EXPECT_EQ(scan.scan.points.front().t_ns, scan.scan.stamp_ns);
  // The clock is wrong, the world is not: the true time of a point is its own minus the offset.
  std::vector<double> thickness;
  for (const LidarPoint& point : scan.scan.points) {
    thickness.push_back(
        DistanceToCubeFace(simulator.TrueWorldFromBody(point.t_ns - 5'000'000) *
                           (scenario.rig[0].T_body_lidar * point.xyz_m.cast<double>())));
  }
  EXPECT_LT(StandardDeviation(thickness), 0.0202);
}

TEST(Simulator, TheScansOfARigComeInTheOrderInWhichTheirSweepsEnd) {
  Scenario scenario = CubeScenario("os1_16");
  scenario.rig.push_back(MakeLidar("mid70"));
  scenario.rig[1].phase_s = 0.05;
  std::vector<int> ids;
  SimulateScans(CubeSimulator(scenario), 0,
                [&](const SimulatedScan& scan) { ids.push_back(scan.scan.lidar_id); });
  EXPECT_EQ(ids, (std::vector<int>{0, 1, 0, 1, 0, 1, 0, 1, 0}));
}

TEST(Simulator, ARepeatedScanIsTheSameInAllItsPoints) {
  Scenario scenario = CubeScenario("os1_16", 1.0);
  scenario.faults.repeated_scan_fraction = 1.0;
  scenario.faults.stamp_jitter_s = 0.003;
  std::vector<LidarScan> scans;
  SimulateScans(CubeSimulator(scenario), 0,
                [&](const SimulatedScan& simulated) { scans.push_back(simulated.scan); });
  ASSERT_EQ(scans.size(), 20U);
  for (std::size_t i = 0; i < scans.size(); i += 2) {
    EXPECT_EQ(scans[i].stamp_ns, scans[i + 1].stamp_ns);
    ASSERT_EQ(scans[i].points.size(), scans[i + 1].points.size());
    EXPECT_EQ(scans[i].points.back().xyz_m, scans[i + 1].points.back().xyz_m);
    EXPECT_EQ(scans[i].points.back().t_ns, scans[i + 1].points.back().t_ns);
  }
}

TEST(Simulator, MotionCorrectedScansFitTheirPoseAtMidSweep) {
  Scenario scenario = CubeScenario("hdl64e", 0.3);
  scenario.motion_corrected = true;
  const Simulator simulator = CubeSimulator(scenario);
  SimulateScans(simulator, 0, [&](const SimulatedScan& simulated) {
    EXPECT_FALSE(simulated.scan.has_point_times);
    EXPECT_EQ(simulated.scan.stamp_ns, simulated.true_start_ns + 50'000'000);
    const SE3 T =
        simulator.TrueWorldFromBody(simulated.scan.stamp_ns) * scenario.rig[0].T_body_lidar;
    std::vector<double> thickness;
    for (const LidarPoint& point : simulated.scan.points) {
      EXPECT_EQ(point.t_ns, simulated.scan.stamp_ns);
      thickness.push_back(DistanceToCubeFace(T * point.xyz_m.cast<double>()));
    }
    EXPECT_LT(StandardDeviation(thickness), 0.0202);
  });
}

TEST(Simulator, RefusesAScenarioWithoutLidarOrTime) {
  Scenario scenario = CubeScenario("os1_16");
  scenario.duration_s = 0.0;
  EXPECT_THROW(CubeSimulator(scenario), std::invalid_argument);
  scenario.duration_s = 1.0;
  scenario.rig.clear();
  EXPECT_THROW(CubeSimulator(scenario), std::invalid_argument);
}

}  // namespace
}  // namespace trajlo::simulation
