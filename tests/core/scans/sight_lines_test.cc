// SPDX-License-Identifier: MIT
#include "core/scans/sight_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trajlo {
namespace {

/// The walls of a room of 20 m, and before one of them a screen, as seen from `eye_m`. Points are
/// in a frame whose origin is at `origin_m`.
LidarScan RoomWithScreen(const Eigen::Vector3f& eye_m, const Eigen::Vector3f& origin_m) {
  LidarScan scan;
  for (int ring = -40; ring <= 40; ++ring) {
    for (int column = 0; column < 1800; ++column) {
      const auto azimuth = static_cast<float>(column * M_PI / 900.0);
      const float elevation = 0.008F * static_cast<float>(ring);
      const Eigen::Vector3f ray(std::cos(azimuth) * std::cos(elevation),
                                std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      float range_m = 1000.0F;
      for (int axis = 0; axis < 3; ++axis) {
        const float wall_m = std::copysign(10.0F, ray[axis]) - eye_m[axis];
        range_m = std::min(range_m, wall_m / ray[axis]);
      }
      const float to_screen_m = (5.0F - eye_m.x()) / ray.x();
      const Eigen::Vector3f on_screen = eye_m + to_screen_m * ray;
      if (to_screen_m > 0.0F && std::abs(on_screen.y()) < 8.0F) {
        range_m = std::min(range_m, to_screen_m);
      }
      scan.points.push_back({eye_m + range_m * ray - origin_m, 0.0F, 0});
    }
  }
  return scan;
}

TEST(SightLines, FromItsOwnPlaceALidarSeesOneThingInADirection) {
  for (const Eigen::Vector3f& eye : {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(7, 6, 0)}) {
    SightLines lines;
    lines.Add(RoomWithScreen(eye, eye));
    EXPECT_GT(lines.asked, 100);
    EXPECT_LT(lines.Share(), 0.05);
    EXPECT_FALSE(lines.AreCrossed());
  }
}

TEST(SightLines, FromAnotherPlaceOneThingLiesBehindTheOther) {
  SightLines lines;
  lines.Add(RoomWithScreen({8, -5, 0}, {0, 0, 0}));
  EXPECT_TRUE(lines.AreCrossed());
}

TEST(SightLines, ADropOfRainIsNoThing) {
  LidarScan scan = RoomWithScreen({0, 0, 0}, {0, 0, 0});
  for (std::size_t i = 0; i < scan.points.size(); i += 19) scan.points[i].xyz_m *= 0.3F;
  SightLines lines;
  lines.Add(scan);
  EXPECT_FALSE(lines.AreCrossed());
}

TEST(SightLines, NothingIsAskedOfWhatIsNotThere) {
  LidarScan scan;
  scan.points.resize(1000);  // All at the origin.
  scan.points[0].xyz_m.setConstant(std::nanf(""));
  SightLines lines;
  lines.Add(scan);
  EXPECT_EQ(lines.asked, 0);
  EXPECT_FALSE(lines.AreCrossed());
}

}  // namespace
}  // namespace trajlo
