// SPDX-License-Identifier: MIT
#include "core/simulation/scenario.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/simulation/scenario_parameters.h"
#include "core/simulation/simulator.h"

namespace trajlo::simulation {
namespace {

TEST(Scenario, AParameterIsSetByNameAndReadsBack) {
  Scenario scenario = MakeScenario("hall_os1_16x2");
  SetParameter(&scenario, "motion.speed_mps", "4.5");
  SetParameter(&scenario, "lidar1.T_body_lidar", "1,2,3,0,0,0,2");
  SetParameter(&scenario, "lidar.range_sigma_m", "0.05");
  SetParameter(&scenario, "faults.end_of_sweep_stamps", "true");
  EXPECT_EQ(scenario.motion.speed_mps, 4.5);
  EXPECT_EQ(scenario.rig[1].T_body_lidar.t, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(scenario.rig[1].T_body_lidar.q.norm(), 1.0);
  EXPECT_EQ(scenario.rig[0].measurement.range_sigma_m, 0.05);
  EXPECT_EQ(scenario.rig[1].measurement.range_sigma_m, 0.05);
  EXPECT_TRUE(scenario.faults.end_of_sweep_stamps);

  // Everything that is written can be read.
  Scenario copy = MakeScenario("hall_os1_16x2");
  for (const Parameter& parameter : Parameters(&scenario)) {
    SetParameter(&copy, parameter.key, ParameterText(parameter));
  }
  const std::vector<Parameter> a = Parameters(&scenario);
  const std::vector<Parameter> b = Parameters(&copy);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(ParameterText(a[i]), ParameterText(b[i]));
}

std::string MessageOf(const std::string& key, const std::string& text) {
  Scenario scenario = MakeScenario("hall_os1_16");
  try {
    SetParameter(&scenario, key, text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Scenario, AKeyThatIsNearNoneComesWithWhereAllAre) {
  EXPECT_EQ(MessageOf("voxels", "1"),
            "there is no parameter 'voxels'; trajlo_simulate --list_parameters shows all of them");
}

TEST(Scenario, AWrongKeyOrValueIsNamedWithTheNearestKey) {
  EXPECT_NE(MessageOf("motion.sped", "1").find("motion.speed_mps"), std::string::npos);
  EXPECT_NE(MessageOf("fault.nan_point_fraction", "1").find("faults.nan_point_fraction"),
            std::string::npos);
  EXPECT_NE(MessageOf("motion.speed_mps", "fast").find("'fast' is not a number"),
            std::string::npos);
  EXPECT_NE(MessageOf("moving_objects", "yes").find("true or false"), std::string::npos);
  EXPECT_NE(MessageOf("lidar0.T_body_lidar", "1,2,3").find("x,y,z,qx,qy,qz,qw"), std::string::npos);
  EXPECT_NE(MessageOf("lidar0.sensor", "os9").find("'os9' is not one of avia, "),
            std::string::npos);
}

TEST(Scenario, AWrongNumberIsNamedWithWhatIsAllowed) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"lidar.columns", "4294967297"},
      {"lidar.columns", "-7"},
      {"lidar.columns", "1e3"},
      {"lidar.range_sigma_m", "nan"},
      {"lidar.dropout_fraction", "nan"},
      {"lidar.max_range_m", "-3"},
      {"lidar.clock_offset_s", "inf"},
      {"faults.dropped_scan_fraction", "2"},
      {"faults.silent_lidar", "1"},
      {"motion.speed_mps", "inf"},
      {"motion.speed_mps", ""},
      {"motion.speed_mps", "1 "},
      {"motion.max_tilt_deg", "0"},
      {"duration_s", "0"},
      {"duration_s", "nan"},
      {"seed", "-1"},
      {"seed", "18446744073709551616"},
      {"start_time_ns", "9000000000000000000"},
      {"lidar0.T_body_lidar", "nan,0,0,0,0,0,1"},
      {"lidar0.T_body_lidar", "0,0,0,0,0,inf,1"},
  };
  for (const auto& [key, text] : mistakes) {
    const std::string message = MessageOf(key, text);
    const std::string name(key);
    EXPECT_NE(message.find(name.substr(name.find('.') + 1)), std::string::npos) << name << text;
    EXPECT_NE(message.find("number from "), std::string::npos) << message;
  }
  EXPECT_EQ(MessageOf("motion.shake", "-2"), "motion.shake: '-2' is not a number from 0 to 1000");
  EXPECT_EQ(MessageOf("seed", "18446744073709551615"), "");
  EXPECT_EQ(MessageOf("lidar0.T_body_lidar", "0, 0, +0.1, 0, 0, 0, 1"), "");
  // Everything that a scenario has by itself is allowed.
  for (const std::string& name : ScenarioNames()) {
    Scenario scenario = MakeScenario(name);
    for (const Parameter& parameter : Parameters(&scenario)) {
      EXPECT_NO_THROW(SetParameter(&scenario, parameter.key, ParameterText(parameter))) << name;
    }
  }
}

TEST(Scenario, WordsAreNamedWithTheirChoices) {
  EXPECT_NE(MessageOf("motion.kind", "run").find("'run' is not one of walk, flight"),
            std::string::npos);
  EXPECT_NE(MessageOf("scene", "mars").find(", hall, "), std::string::npos);
}

TEST(Scenario, SensorsAreSetBeforeTheirNumbers) {
  for (const bool sensor_first : {false, true}) {
    std::vector<std::pair<std::string, std::string>> settings = {
        {"lidar0.range_sigma_m", "0.5"}, {"motion.shake", "0"}, {"lidar.sensor", "vlp16"}};
    if (sensor_first) std::swap(settings.front(), settings.back());
    Scenario scenario = MakeScenario("hall_os1_16");
    SetParameters(&scenario, settings);
    EXPECT_EQ(scenario.rig[0].sensor, "vlp16");
    EXPECT_EQ(scenario.rig[0].measurement.range_sigma_m, 0.5);
    EXPECT_EQ(scenario.motion.shake, 0.0);
  }
}

TEST(Scenario, ANewSensorBringsItsOwnMeasurementModel) {
  Scenario scenario = MakeScenario("hall_os1_16");
  SetParameter(&scenario, "lidar0.sensor", "pandar_xt32");
  EXPECT_EQ(scenario.rig[0].measurement.range_sigma_m, 0.01);
}

TEST(Scenario, AnUnknownNameIsRefused) {
  EXPECT_THROW(MakeScenario("mars"), std::invalid_argument);
}

class AnyScenario : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Names, AnyScenario, testing::ValuesIn(ScenarioNames()),
                         [](const auto& instance) { return instance.param; });

/// The distance from a point to the nearest surface, to within a few degrees of direction.
double Clearance(const Scene& scene, const Eigen::Vector3d& position) {
  constexpr int kRays = 150;
  double clearance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kRays; ++i) {  // A Fibonacci sphere.
    const double z = 1.0 - 2.0 * (i + 0.5) / kRays;
    const double azimuth = i * M_PI * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(r * std::cos(azimuth), r * std::sin(azimuth), z);
    const auto hit = scene.CastRay(position, direction, 0.0, 5.0);
    if (hit) clearance = std::min(clearance, hit->range_m);
  }
  return clearance;
}

TEST_P(AnyScenario, KeepsClearOfWallsForAMinuteAndSixSeeds) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Scenario scenario = MakeScenario(GetParam());
    scenario.seed = seed;
    scenario.duration_s = 60.0;
    scenario.moving_objects = false;
    const Simulator simulator(scenario);
    Eigen::Vector3d previous = simulator.TrueWorldFromBody(simulator.start_ns()).t;
    for (std::int64_t t = simulator.start_ns(); t < simulator.end_ns(); t += 100'000'000) {
      const Eigen::Vector3d position = simulator.TrueWorldFromBody(t).t;
      ASSERT_GT(Clearance(simulator.scene(), position), 0.22)
          << "at " << position.transpose() << ", seed " << seed;
      const double step = (position - previous).norm();
      if (step > 1e-6) {
        const auto hit =
            simulator.scene().CastRay(previous, (position - previous) / step, 0.0, step);
        ASSERT_FALSE(hit) << "through a wall at " << position.transpose();
      }
      previous = position;
    }
  }
}

TEST_P(AnyScenario, GivesManyPointsAllAlong) {
  constexpr std::int64_t kScans = 12;
  const Simulator simulator(MakeScenario(GetParam()));
  for (int id = 0; id < static_cast<int>(simulator.scenario().rig.size()); ++id) {
    const std::int64_t last = simulator.ScanCount(id) - 1;
    ASSERT_GE(last, kScans);
    for (std::int64_t i = 0; i < kScans; ++i) {
      const std::int64_t index = i * last / (kScans - 1);
      EXPECT_GT(simulator.SimulateScan(id, index).scan.points.size(), 2000U)
          << "LiDAR " << id << ", scan " << index;
    }
  }
}

}  // namespace
}  // namespace trajlo::simulation
