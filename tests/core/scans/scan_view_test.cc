// SPDX-License-Identifier: MIT
#include "core/scans/scan_view.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

using testing::SyntheticWorld;

SE3 Along(double speed_m_s, double turn_rad_s, double t) {
  Vector6d twist = Vector6d::Zero();
  twist[0] = speed_m_s;
  twist[5] = turn_rad_s;
  return se3::Exp(t * twist);
}

std::vector<ScanView> Views(const SyntheticWorld& world, int count) {
  std::vector<ScanView> views;
  for (int i = 0; i < count; ++i) views.emplace_back(world.Sweep(i));
  return views;
}

TEST(ScanView, DiffersTheMoreTheFartherOneMoved) {
  for (const auto& [speed_m_s, turn_rad_s] :
       {std::pair(2.0, 0.0), std::pair(5.0, 0.3), std::pair(0.0, 0.8)}) {
    SyntheticWorld world;
    world.T_world_body = [speed = speed_m_s, turn = turn_rad_s](double t) {
      return Along(speed, turn, t);
    };
    const std::vector<ScanView> views = Views(world, 8);
    for (std::size_t i = 0; i + 2 < views.size(); ++i) {
      const auto next = ScanView::Difference(views[i], views[i + 1]);
      const auto second_next = ScanView::Difference(views[i], views[i + 2]);
      ASSERT_TRUE(next && second_next);
      EXPECT_LT(*next, 0.9 * *second_next) << speed_m_s << " m/s, " << turn_rad_s << " rad/s";
      EXPECT_EQ(*ScanView::Difference(views[i + 1], views[i]), *next);
    }
  }
}

TEST(ScanView, AtRestOnlyNoiseDiffers) {
  const std::vector<ScanView> views = Views(SyntheticWorld(), 3);
  EXPECT_LT(*ScanView::Difference(views[0], views[1]), 0.01);
  EXPECT_NEAR(*ScanView::Difference(views[0], views[1]), *ScanView::Difference(views[0], views[2]),
              0.002);
}

TEST(ScanView, FewReturnsTellNothing) {
  LidarScan scan = SyntheticWorld().Sweep(0);
  const ScanView whole(scan);
  EXPECT_FALSE(ScanView::Difference(whole, ScanView()));
  for (std::size_t i = 20; i < scan.points.size(); ++i) {
    const float value = i % 2 == 0 ? 0.0F : std::numeric_limits<float>::quiet_NaN();
    scan.points[i].xyz_m.setConstant(value);
  }
  EXPECT_FALSE(ScanView::Difference(whole, ScanView(scan)));
  scan.points.clear();
  EXPECT_FALSE(ScanView::Difference(ScanView(scan), ScanView(scan)));
}

}  // namespace
}  // namespace trajlo
