// SPDX-License-Identifier: MIT
#include "core/odometry/window/deskew.h"

#include <gtest/gtest.h>

#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

/// Points of a wall and a floor within 20 m, at random times of the segment.
SegmentCloud RandomCloud(testing::Random* random) {
  SegmentCloud cloud;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random->Vector(0.5, 20.0);
    const auto alpha = static_cast<float>(random->Uniform(0.0, 1.0));
    cloud.map_points.push_back({p.cast<float>(), alpha});
    if (i % 4 == 0) cloud.registration_points.push_back(cloud.map_points.back());
  }
  return cloud;
}

/// The largest distance between where the deskewed points of one pose are in the world and where
/// their own times' poses put them.
template <typename PoseAt>
double LargestDistance(const SegmentCloud& raw, const SegmentCloud& deskewed,
                       const PoseAt& pose_at) {
  double largest = 0.0;
  for (std::size_t i = 0; i < raw.map_points.size(); ++i) {
    const Eigen::Vector3d truth =
        pose_at(raw.map_points[i].alpha) * raw.map_points[i].p_body_m.template cast<double>();
    const Eigen::Vector3d moved =
        pose_at(1.0) * deskewed.map_points[i].p_body_m.template cast<double>();
    largest = std::max(largest, (truth - moved).norm());
  }
  return largest;
}

TEST(Deskew, PutsThePointsWhereTheContinuousTrajectoryPutsThemIfTheTwistIsConstant) {
  testing::Random random(7);
  for (int i = 0; i < 20; ++i) {
    const SE3 T_begin = random.Pose(50.0);
    Vector6d tau;
    tau.head<3>() = random.Vector(0.0, 3.0);
    tau.tail<3>() = random.Vector(0.0, 2.0);
    const SegmentCloud raw = RandomCloud(&random);
    SegmentCloud deskewed = raw;
    DeskewToEnd(tau, &deskewed);
    const SE3 T_end = Plus(T_begin, tau);
    const auto pose_at = [&](double alpha) { return Interpolate(T_begin, T_end, alpha); };
    EXPECT_LT(LargestDistance(raw, deskewed, pose_at), 1e-5);  // Points are floats.
  }
}

TEST(Deskew, LeavesOneTimeForAllPointsOfBothLists) {
  testing::Random random(8);
  SegmentCloud cloud = RandomCloud(&random);
  Vector6d tau = Vector6d::Zero();
  tau[5] = 0.3;
  DeskewToEnd(tau, &cloud);
  for (const auto& points : {cloud.map_points, cloud.registration_points}) {
    for (const SegmentPoint& point : points) EXPECT_EQ(point.alpha, 1.0F);
  }
  for (std::size_t i = 0; i < cloud.registration_points.size(); ++i) {
    EXPECT_EQ(cloud.registration_points[i].p_body_m, cloud.map_points[4 * i].p_body_m);
  }
}

TEST(Deskew, ATurnThatBeginsInTheSegmentIsNotInThePrediction) {
  testing::Random random(9);
  const SegmentCloud raw = RandomCloud(&random);
  SegmentCloud deskewed = raw;
  DeskewToEnd(Vector6d::Zero(), &deskewed);  // It stood still until now.
  const auto turning = [](double alpha) { return SE3(so3::Exp({0, 0, 0.1 * alpha}), {0, 0, 0}); };
  const double error_m = LargestDistance(raw, deskewed, turning);
  EXPECT_GT(error_m, 1.0);
  EXPECT_LT(error_m, 2.0);  // 0.1 rad at 20 m.
}

}  // namespace
}  // namespace trajlo
