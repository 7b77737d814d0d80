// SPDX-License-Identifier: MIT
#include "core/odometry/window/points_to_world.h"

#include <gtest/gtest.h>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

TEST(PointsToWorld, EachPointKnowsWhereItsLidarWas) {
  testing::Random random(4);
  const std::vector<Eigen::Vector3d> origins_body_m = {{0.1, 0.0, 0.2}, {-0.3, 0.1, 0.0}};
  const SE3 T_begin = random.Pose(5.0);
  const SE3 T_end = T_begin * se3::Exp(0.05 * Vector6d::Ones());
  const SegmentMotion motion(T_begin, T_end);
  std::vector<SegmentPoint> points;
  for (int i = 0; i < 13; ++i) {
    points.push_back({(3.0 * random.Direction()).cast<float>(), static_cast<float>(i) / 12.0F,
                      static_cast<std::uint16_t>(i % 2)});
  }
  const std::vector<MapPoint> map_points =
      ToMapPoints(motion, LidarPaths(origins_body_m, T_begin, T_end), points.data(), points.size());
  ASSERT_EQ(map_points.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& origin_body_m = origins_body_m[points[i].lidar];
    const Eigen::Vector3d place =
        motion.ToWorld(points[i].alpha, points[i].p_body_m.cast<double>());
    const Eigen::Vector3d sensor = motion.ToWorld(points[i].alpha, origin_body_m);
    EXPECT_LT((map_points[i].place_world - place).norm(), 1e-12);
    // The way of the LiDAR bends by less than a millimetre.
    EXPECT_LT((map_points[i].to_sensor_world.cast<double>() - (sensor - place)).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace trajlo
