// SPDX-License-Identifier: MIT
// Pauses in recordings of a body at 3 m/s and 1 rad/s: its place is found again, or it says that it
// is lost; a pose that carries no flag is right.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "core/odometry/odometry.h"
#include "core/simulation/faults.h"
#include "core/simulation/scenario.h"
#include "core/simulation/simulator.h"

namespace trajlo {
namespace {

using simulation::SimulatedScan;
using simulation::Simulator;

constexpr double kPauseFrom_s = 4.0;
constexpr double kAfter_s = 1.5;
constexpr unsigned kNotMeasured = kFlagNoPoints | kFlagGap | kFlagReverted | kFlagLost;

/// At rest, then ever faster up to 1 rad/s.
double Turned(double t_s) {
  const double s = std::max(0.0, t_s - 0.5);
  return s < 1.0 ? 0.5 * s * s : s - 0.5;
}

/// A scenario at 3 m/s in which the body turns about its vertical at 1 rad/s besides.
Simulator Turning(const std::string& name) {
  simulation::Scenario scenario = simulation::MakeScenario(name);
  scenario.motion.speed_mps = 3.0;
  scenario.motion.moving_start = false;
  scenario.motion.rest_s = 0.5;
  scenario.duration_s = kPauseFrom_s + 5.0 + kAfter_s;
  for (auto& lidar : scenario.rig) lidar.columns = 512;
  const auto plain = std::make_shared<Simulator>(scenario);
  const auto turning = [plain](double t_s) {
    const auto t_ns = plain->start_ns() + std::llround(1e9 * t_s);
    return plain->TrueWorldFromBody(t_ns) * SE3(so3::Exp({0.0, 0.0, Turned(t_s)}), {0.0, 0.0, 0.0});
  };
  return {scenario, simulation::Scene(plain->scene().mesh()), turning};
}

/// A recording, simulated once for all pauses.
struct Recording {
  Simulator simulator;
  std::vector<SimulatedScan> scans;

  explicit Recording(const std::string& name) : simulator(Turning(name)) {
    simulation::SimulateScans(simulator, 2, [&](const auto& scan) { scans.push_back(scan); });
  }
};

const Recording& RecordingOf(const std::string& name) {
  static std::map<std::string, Recording> recordings;
  const auto found = recordings.find(name);
  return found != recordings.end() ? found->second : recordings.emplace(name, name).first->second;
}

struct Result {
  double at_end_m = 0.0;     ///< Error of the last pose.
  double unflagged_m = 0.0;  ///< Largest error of a pose without a flag.
  double flagged_s = 0.0;    ///< Time that flagged poses end.
  double speed_m_s = 0.0;    ///< Largest, from pose to pose.
  bool is_lost = false;
  bool has_flag_at_end = false;
};

Result RunWith(const std::string& name, const simulation::FaultConfig& faults, double end_s) {
  const Recording& recording = RecordingOf(name);
  const Simulator& simulator = recording.simulator;
  simulation::FaultInjector injector(faults, 1, simulator.start_ns());
  OdometryOptions options;
  for (const auto& lidar : simulator.scenario().rig) {
    options.segmenter.T_body_lidar.push_back(lidar.T_body_lidar);
  }
  Odometry odometry(options);
  for (SimulatedScan scan : recording.scans) {
    if (1e-9 * static_cast<double>(scan.true_start_ns - simulator.start_ns()) > end_s) break;
    if (injector.Apply(&scan)) odometry.AddScan(scan.scan);
  }
  odometry.Finish();

  Result result;
  result.is_lost = odometry.lost_at_ns().has_value();
  const std::vector<ControlPose>& poses = odometry.trajectory().poses();
  const SE3 T_start_world = simulator.TrueWorldFromBody(poses.front().t_ns).Inverse();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const SE3 truth = T_start_world * simulator.TrueWorldFromBody(poses[i].t_ns);
    result.at_end_m = (poses[i].T_world_body.t - truth.t).norm();
    result.has_flag_at_end = (poses[i].flags & kNotMeasured) != 0;
    const bool is_lost = result.is_lost && poses[i].t_ns >= *odometry.lost_at_ns();
    if (!result.has_flag_at_end && !is_lost) {
      result.unflagged_m = std::max(result.unflagged_m, result.at_end_m);
    }
    if (i == 0) continue;
    const double duration_s = 1e-9 * static_cast<double>(poses[i].t_ns - poses[i - 1].t_ns);
    if (result.has_flag_at_end) result.flagged_s += duration_s;
    const double way_m = (poses[i].T_world_body.t - poses[i - 1].T_world_body.t).norm();
    result.speed_m_s = std::max(result.speed_m_s, way_m / duration_s);
  }
  std::printf("%-18s pause %.1f s, cover %.1f s: end %.3f m, unflagged %.3f m, flagged %.2f s%s\n",
              name.c_str(), faults.pause_s, faults.cover_s, result.at_end_m, result.unflagged_m,
              result.flagged_s, result.is_lost ? ", LOST" : "");
  std::fflush(stdout);
  return result;
}

Result RunWithPause(const std::string& name, double pause_s) {
  simulation::FaultConfig faults;
  faults.pause_from_s = kPauseFrom_s;
  faults.pause_s = pause_s;
  return RunWith(name, faults, kPauseFrom_s + pause_s + kAfter_s);
}

class Pauses : public ::testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(Pauses, ThePlaceIsFoundAgainOrTheRunIsLost) {
  const auto [name, pause_s] = GetParam();
  const Result result = RunWithPause(name, pause_s);
  EXPECT_LT(result.unflagged_m, 0.3);
  EXPECT_GT(result.flagged_s, pause_s - 0.2);
  EXPECT_LT(result.speed_m_s, 100.0);
  if (result.is_lost) return;
  EXPECT_LT(result.at_end_m, 0.15);
  EXPECT_FALSE(result.has_flag_at_end);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Pauses,
                         ::testing::Combine(::testing::Values("hall_os1_16", "office_os0_64",
                                                              "courtyard_os1_16", "street_hdl64"),
                                            ::testing::Values(0.5, 1.0, 2.0, 3.0, 5.0)),
                         [](const auto& test) {
                           const int tenths = static_cast<int>(10.0 * std::get<1>(test.param));
                           return std::string(std::get<0>(test.param)) + "_" +
                                  std::to_string(tenths) + "_tenths";
                         });

/// In the others the body may be where the map does not reach, as in the next room of the office,
/// or where it looks the same twice.
class ShortPauses : public ::testing::TestWithParam<const char*> {};

TEST_P(ShortPauses, ThePlaceIsFoundAgain) {
  for (const double pause_s : {0.5, 1.0}) {
    EXPECT_FALSE(RunWithPause(GetParam(), pause_s).is_lost) << pause_s;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShortPauses,
                         ::testing::Values("hall_os1_16", "courtyard_os1_16", "street_hdl64"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Covered, APlaceIsFoundAgainWhenTheLidarSeesAgain) {
  simulation::FaultConfig faults;
  faults.cover_from_s = kPauseFrom_s;
  faults.cover_s = 2.0;
  const Result result = RunWith("courtyard_os1_16", faults, kPauseFrom_s + 2.0 + kAfter_s);
  EXPECT_FALSE(result.is_lost);
  EXPECT_LT(result.unflagged_m, 0.3);
  EXPECT_LT(result.at_end_m, 0.15);
  EXPECT_GT(result.flagged_s, 1.8);
  EXPECT_LT(result.speed_m_s, 100.0);
}

}  // namespace
}  // namespace trajlo
