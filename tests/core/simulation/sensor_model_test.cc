// SPDX-License-Identifier: MIT
#include "core/simulation/sensors/sensor_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace trajlo::simulation {
namespace {

constexpr double kDegPerRad = 180.0 / M_PI;

double ElevationDeg(const Firing& firing) { return std::asin(firing.direction.z()) * kDegPerRad; }

/// What the data sheets say.
struct DataSheet {
  const char* name;
  int points_per_second;  // Fired, at 10 scans a second.
  double elevation_low_deg, elevation_high_deg;
};
std::ostream& operator<<(std::ostream& out, const DataSheet& sheet) { return out << sheet.name; }

class Sensor : public testing::TestWithParam<DataSheet> {};
INSTANTIATE_TEST_SUITE_P(DataSheets, Sensor,
                         testing::Values(DataSheet{"os1_16", 163'840, -16.611, 16.611},
                                         DataSheet{"os0_64", 655'360, -45.0, 45.0},
                                         DataSheet{"os1_128", 1'310'720, -21.2, 21.2},
                                         DataSheet{"vlp16", 289'280, -15.0, 15.0},
                                         DataSheet{"hdl32e", 694'400, -30.667, 10.667},
                                         DataSheet{"hdl64e", 1'333'120, -24.33, 2.0},
                                         DataSheet{"pandar_xt32", 640'000, -16.0, 15.0},
                                         DataSheet{"mid70", 100'000, -35.2, 35.2},
                                         DataSheet{"avia", 240'000, -38.6, 38.6},
                                         DataSheet{"mid360", 200'000, -7.22, 55.22}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST_P(Sensor, FiresAsOftenAndAsHighAsPublished) {
  const SensorModel sensor = MakeSensor(GetParam().name);
  const ScanPattern& pattern = *sensor.pattern;
  EXPECT_EQ(pattern.period_ns(), 100'000'000);
  EXPECT_EQ(pattern.firings_per_scan() * 10, GetParam().points_per_second);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < pattern.firings_per_scan(); ++i) {
    const double elevation = ElevationDeg(pattern.At(3, i));
    low = std::min(low, elevation);
    high = std::max(high, elevation);
  }
  EXPECT_NEAR(low, GetParam().elevation_low_deg, 0.2);
  EXPECT_NEAR(high, GetParam().elevation_high_deg, 0.2);
}

TEST_P(Sensor, FiresUnitDirectionsWithinItsPeriod) {
  const SensorModel sensor = MakeSensor(GetParam().name);
  const ScanPattern& pattern = *sensor.pattern;
  std::int64_t latest = 0;
  for (int i = 0; i < pattern.firings_per_scan(); ++i) {
    const Firing firing = pattern.At(0, i);
    ASSERT_NEAR(firing.direction.norm(), 1.0, 1e-12);
    ASSERT_GE(firing.offset_ns, 0);
    ASSERT_LT(firing.offset_ns, pattern.period_ns());
    latest = std::max(latest, firing.offset_ns);
  }
  EXPECT_GT(latest, 99'000'000);
}

TEST(SpinningPattern, TurnsOnceClockwiseDuringAScan) {
  for (const char* name : {"os1_16", "os0_64", "vlp16", "hdl32e", "hdl64e", "pandar_xt32"}) {
    const SensorModel sensor = MakeSensor(name);
    double turned = 0.0;
    double previous = 0.0;
    const int beams = sensor.pattern->firings_per_scan();
    const double elevation = ElevationDeg(sensor.pattern->At(0, 0));
    int columns = 0;
    for (int i = 0; i < beams; ++i) {
      const Firing firing = sensor.pattern->At(0, i);
      if (std::abs(ElevationDeg(firing) - elevation) > 1e-9) continue;
      const double azimuth = std::atan2(firing.direction.y(), firing.direction.x());
      if (columns++ > 0) turned += std::remainder(azimuth - previous, 2.0 * M_PI);
      previous = azimuth;
    }
    EXPECT_NEAR(turned, -2.0 * M_PI * (columns - 1) / columns, 0.01) << name;
  }
}

TEST(SpinningPattern, TheColumnsOfAnOusterFireAtOnceAndThoseOfAVelodyneOneByOne) {
  const SensorModel ouster = MakeSensor("os1_16");
  EXPECT_EQ(ouster.pattern->At(0, 0).offset_ns, ouster.pattern->At(0, 15).offset_ns);
  EXPECT_EQ(ouster.pattern->At(0, 16).offset_ns, 97'656);
  const SensorModel velodyne = MakeSensor("vlp16");
  EXPECT_EQ(velodyne.pattern->At(0, 1).offset_ns, 2'304);
  EXPECT_EQ(velodyne.pattern->At(0, 16).offset_ns, 55'296);
}

TEST(SpinningPattern, FewerColumnsStillCoverTheTurn) {
  const SensorModel sensor = MakeSensor("hdl64e", 1024);
  EXPECT_EQ(sensor.pattern->firings_per_scan(), 64 * 1024);
  const int last_column = 64 * 1023;
  EXPECT_NEAR(static_cast<double>(sensor.pattern->At(0, last_column).offset_ns), 99.9e6, 0.1e6);
}

TEST(LivoxPattern, NeverRepeatsAndFillsItsFieldOfViewOverTime) {
  for (const char* name : {"mid70", "avia", "mid360"}) {
    const SensorModel sensor = MakeSensor(name);
    std::set<std::pair<int, int>> cells;
    std::vector<std::size_t> seen;
    for (int scan = 0; scan < 10; ++scan) {
      for (int i = 0; i < sensor.pattern->firings_per_scan(); ++i) {
        const Eigen::Vector3d d = sensor.pattern->At(scan, i).direction;
        cells.insert({static_cast<int>(std::floor(std::atan2(d.y(), d.x()) * kDegPerRad)),
                      static_cast<int>(std::floor(std::asin(d.z()) * kDegPerRad))});
      }
      seen.push_back(cells.size());
    }
    EXPECT_GT(seen[9], seen[0] * 5 / 4) << name;
    EXPECT_GE(seen[9], seen[4]) << name;
  }
}

TEST(LivoxPattern, TheRosetteIsACircleOfItsFieldOfView) {
  const SensorModel sensor = MakeSensor("mid70");
  double widest = 0.0;
  for (int i = 0; i < sensor.pattern->firings_per_scan(); ++i) {
    widest = std::max(widest, std::acos(sensor.pattern->At(0, i).direction.x()) * kDegPerRad);
  }
  EXPECT_NEAR(widest, 35.2, 0.05);
}

TEST(MakeSensor, KnowsItsNamesAndRefusesOthers) {
  EXPECT_EQ(SensorNames().size(), 10U);
  for (const std::string& name : SensorNames()) EXPECT_EQ(MakeSensor(name).name, name);
  EXPECT_THROW(MakeSensor("os9"), std::invalid_argument);
}

}  // namespace
}  // namespace trajlo::simulation
