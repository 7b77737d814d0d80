// SPDX-License-Identifier: MIT
#include "core/odometry/window/sliding_window.h"

#include <gtest/gtest.h>

#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

TEST(SlidingWindow, AWindowThatIsRevertedLeavesNoPullInThePrior) {
  // A room that jumps by a third of a metre after the first sweep; no correction is believed.
  testing::SyntheticWorld world;
  world.T_world_body = [](double t) { return SE3({1, 0, 0, 0}, {t < 0.1 ? 0.0 : 0.3, 0.0, 0.0}); };
  for (const double max_correction_m : {1e-6, 3.0}) {
    OdometryOptions options;
    options.segmenter.first_interval_s = 0.1;
    options.lost.max_correction_m = max_correction_m;
    Segmenter segmenter(options.segmenter);
    for (int i = 0; i < 4; ++i) segmenter.AddScan(world.Sweep(i));
    MapPyramid map(options.map);
    std::vector<Eigen::Vector3d> points;
    const auto first = segmenter.Next();
    ASSERT_TRUE(first);
    for (const SegmentPoint& point : first->map_points) {
      points.push_back(point.p_body_m.cast<double>());
    }
    map.Insert(points);
    ThreadPool threads(1);
    SlidingWindow window(options, &map, &threads, MakeWindowSolver);
    window.Start(0, SE3(), Vector6d::Zero());
    WindowStatistics statistics;
    for (int k = 0; k < 4; ++k) statistics = window.AddSegment(*segmenter.Next());
    window.Marginalize();
    const bool is_reverted = statistics.flags & kFlagReverted;
    EXPECT_EQ(is_reverted, max_correction_m < 1.0);
    EXPECT_EQ(window.prior().Gradient().norm() == 0.0, is_reverted);
    EXPECT_GT(window.prior().Information().trace(), 0.0);
  }
}

}  // namespace
}  // namespace trajlo
