// SPDX-License-Identifier: MIT
#include "core/io/inspection/point_summary.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace trajlo {
namespace {

LidarScan ScanOf(const std::vector<Eigen::Vector3f>& points) {
  LidarScan scan;
  for (const Eigen::Vector3f& point : points) scan.points.push_back({point, 0.0F, 0});
  return scan;
}

TEST(PointCounter, CountsWhatIsNoReturnAndMeasuresTheRest) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Eigen::Vector3f> points = {{kNan, 0, 0}, {0, 0, 0}};
  for (int i = 1; i <= 200; ++i) points.emplace_back(0.0F, 0.1F * static_cast<float>(i), 0.0F);
  PointCounter counter;
  counter.Add({}, ScanOf(points));
  counter.Add({}, ScanOf({}));
  const PointSummary summary = counter.Summarise();
  EXPECT_EQ(summary.total, 202u);
  EXPECT_EQ(summary.not_finite, 1u);
  EXPECT_EQ(summary.at_origin, 1u);
  EXPECT_EQ(summary.empty_messages, 1u);
  EXPECT_EQ(summary.fewest, 0u);
  EXPECT_EQ(summary.most, 202u);
  EXPECT_NEAR(summary.range_min_m, 0.1, 1e-6);
  EXPECT_NEAR(summary.range_median_m, 10.0, 0.02);
  EXPECT_NEAR(summary.range_99_m, 19.8, 0.02);
  EXPECT_NEAR(summary.range_max_m, 20.0, 1e-5);
  EXPECT_FALSE(summary.rings);
}

TEST(PointCounter, RangesOfMillimetresAreTold) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 1; i <= 1000; ++i) points.emplace_back(0.0F, 0.0F, 20.0F * static_cast<float>(i));
  PointCounter counter;
  counter.Add({}, ScanOf(points));
  const PointSummary summary = counter.Summarise();
  EXPECT_NEAR(summary.range_median_m, 10'000.0, 10.0);
  EXPECT_NEAR(summary.range_99_m, 19'800.0, 10.0);
}

TEST(PointCounter, RangesBeyondTheHistogramDoNotBreakIt) {
  PointCounter counter;
  counter.Add({}, ScanOf({{1e30F, 0, 0}, {1e-3F, 0, 0}}));
  const PointSummary summary = counter.Summarise();
  EXPECT_NEAR(summary.range_min_m, 1e-3, 1e-9);
  EXPECT_GT(summary.range_max_m, 9e29);
  EXPECT_TRUE(std::isfinite(summary.range_99_m));
}

}  // namespace
}  // namespace trajlo
