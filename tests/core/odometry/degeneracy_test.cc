// SPDX-License-Identifier: MIT
// What the geometry does not hold is flagged, with its direction; what it holds is not.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/odometry/odometry.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

using testing::Box;
using testing::SyntheticWorld;

constexpr double kFar = 1e4;

struct Scene {
  const char* name;
  Box room;
  Eigen::Vector3d velocity_m_s;
  int columns;
  double sway;                ///< 1: as whatever carries a LiDAR does; 0: none.
  Eigen::Vector3d weak_axis;  ///< Zero: every direction is held.
};

/// Starts after half a second, swaying by two degrees times `sway`.
SE3 Sway(const Eigen::Vector3d& velocity_m_s, double sway, double t) {
  const double way_s = t < 0.5 ? 0.0 : t < 1.5 ? 0.5 * (t - 0.5) * (t - 0.5) : t - 1.0;
  const double grown = std::min(1.0, std::max(0.0, t - 0.3));
  const Eigen::Vector3d angle(std::sin(5.0 * t), std::sin(7.0 * t + 1.0), std::sin(4.0 * t + 2.0));
  return SE3(so3::Exp(0.035 * sway * grown * angle), velocity_m_s * way_s);
}

struct Judgement {
  double degenerate_share = 0.0;
  double right_axis_share = 0.0;  ///< Of the flagged windows.
};

Judgement JudgementOf(const Scene& scene) {
  SyntheticWorld world;
  world.boxes = {scene.room};
  world.beams = 16;
  world.columns = scene.columns;
  world.noise_m = 0.02;
  world.T_world_body = [&](double t) { return Sway(scene.velocity_m_s, scene.sway, t); };
  OdometryOptions options;
  Odometry odometry(options);
  int windows = 0, degenerate = 0, right = 0;
  odometry.OnWindow([&](const WindowStatistics& w) {
    if (++windows <= 10) return;  // The map of the first scan is not finished.
    if ((w.flags & kFlagDegenerate) == 0) return;
    ++degenerate;
    int largest = 0;
    w.weak_direction.cwiseAbs().maxCoeff(&largest);
    right += largest < 3 && scene.weak_axis[largest] != 0.0 ? 1 : 0;
  });
  for (int i = 0; i < 30; ++i) {
    LidarScan scan = world.Sweep(i);
    auto is_far = [](const LidarPoint& point) { return !(point.xyz_m.norm() < 100.0F); };
    scan.points.erase(std::remove_if(scan.points.begin(), scan.points.end(), is_far),
                      scan.points.end());
    odometry.AddScan(scan);
  }
  odometry.Finish();
  return {static_cast<double>(degenerate) / (windows - 10),
          degenerate > 0 ? static_cast<double>(right) / degenerate : 0.0};
}

class Degeneracy : public ::testing::TestWithParam<Scene> {};

TEST_P(Degeneracy, IsFlaggedWithItsDirectionAndNothingElseIs) {
  const Judgement judgement = JudgementOf(GetParam());
  if (GetParam().weak_axis.isZero()) {
    EXPECT_LT(judgement.degenerate_share, 0.03);
  } else {
    EXPECT_GT(judgement.degenerate_share, 0.8);
    EXPECT_GT(judgement.right_axis_share, 0.9);
  }
}

const Eigen::Vector3d kX = Eigen::Vector3d::UnitX(), kZ = Eigen::Vector3d::UnitZ();
const Box kCorridor = {{-kFar, -1.2, -1.3}, {kFar, 1.2, 1.5}};
const Box kTunnel = {{-kFar, -5, -2}, {kFar, 5, 6}};
const Box kStreet = {{-kFar, -9, -2}, {kFar, 9, kFar}};
const Box kShaft = {{-6, -5, -kFar}, {7, 6, kFar}};
const Scene kScenes[] = {
    {"Room", {{-6, -5, -1.5}, {7, 6, 3}}, 0.6 * kX, 900, 1, {0, 0, 0}},
    {"RoomOfFewRays", {{-6, -5, -1.5}, {7, 6, 3}}, 0.6 * kX, 25, 1, {0, 0, 0}},
    {"Hall", {{-16, -15, -3}, {17, 16, 8}}, kX, 900, 1, {0, 0, 0}},
    {"Corridor", kCorridor, kX, 900, 1, kX},
    {"CorridorWithoutSway", kCorridor, kX, 900, 0, kX},
    {"Tunnel", kTunnel, 5.0 * kX, 900, 1, kX},
    {"TunnelOfFewRays", kTunnel, 5.0 * kX, 25, 1, kX},
    {"Street", kStreet, 8.0 * kX, 180, 1, kX},
    {"StreetOfFewRays", kStreet, 8.0 * kX, 25, 1, kX},
    {"StreetOfFewRaysWithoutSway", kStreet, 8.0 * kX, 25, 0, kX},
    {"Shaft", kShaft, 0.6 * kZ, 900, 1, kZ},
    {"ShaftWithoutSway", kShaft, 0.6 * kZ, 900, 0, kZ},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Degeneracy, ::testing::ValuesIn(kScenes),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace trajlo
