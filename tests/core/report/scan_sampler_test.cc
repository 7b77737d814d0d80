// SPDX-License-Identifier: MIT
#include "core/report/scan_sampler.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/io/point_file.h"
#include "core/odometry/segments/turn_up.h"
#include "core/report/view_ply.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Le;
using ::testing::SizeIs;

constexpr std::int64_t kSweep_ns = 100'000'000;
constexpr std::int64_t kStart_ns = 1'600'000'000'000'000'000;
constexpr int kRings = 16;

/// A body that drives a curve and turns about all axes.
SE3 PoseAt(std::int64_t t_ns) {
  const double t = 1e-9 * static_cast<double>(t_ns - kStart_ns);
  SE3 T;
  T.q = Eigen::AngleAxisd(0.4 * t, Eigen::Vector3d(0.2, -0.1, 1.0).normalized());
  T.t = Eigen::Vector3d(5.0 * std::cos(0.2 * t), 5.0 * std::sin(0.2 * t), 0.1 * t);
  return T;
}

Trajectory Drive(double seconds) {
  Trajectory trajectory;
  const auto poses = static_cast<std::int64_t>(seconds / 0.01) + 1;
  for (std::int64_t i = 0; i < poses; ++i) {
    const std::int64_t t_ns = kStart_ns + i * 10'000'000;
    trajectory.Append({t_ns, PoseAt(t_ns)});
  }
  return trajectory;
}

/// A sphere of 8 m around the sensor; the intensity is the number of the ring.
LidarScan Sweep(int index, int columns = 256) {
  LidarScan scan;
  scan.stamp_ns = kStart_ns + index * kSweep_ns;
  for (int column = 0; column < columns; ++column) {
    const double azimuth = 2.0 * M_PI * column / columns;
    for (int ring = 0; ring < kRings; ++ring) {
      const double elevation = (2.0 * ring - 15.0) * M_PI / 180.0;
      LidarPoint point;
      point.xyz_m =
          8.0F * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                 std::cos(elevation) * std::sin(azimuth), std::sin(elevation))
                     .cast<float>();
      point.intensity = static_cast<float>(ring);
      point.t_ns = scan.stamp_ns + kSweep_ns * column / columns;
      scan.points.push_back(point);
    }
  }
  return scan;
}

std::map<std::int64_t, int> PointsPerMoment(const std::vector<WorldPoint>& points) {
  std::map<std::int64_t, int> counts;
  for (const WorldPoint& point : points) ++counts[point.moment_ns];
  return counts;
}

TEST(ScanSamplerTest, MomentsAreEvenOverARunOfAnyLengthAndTheirNumberIsBounded) {
  ScanSamplingOptions options;
  options.max_moments = 20;
  options.points_per_moment = 50;
  for (const int sweeps : {1, 19, 20, 21, 100, 333}) {
    ScanSampler sampler({}, options);
    for (int i = 0; i < sweeps; ++i) sampler.Note(Sweep(i, 16));
    const auto counts = PointsPerMoment(sampler.Deskew(Drive(0.1 * sweeps), {}));
    EXPECT_LE(counts.size(), 20u);
    EXPECT_GE(counts.size(), std::min<std::size_t>(sweeps, 10));
    std::set<std::int64_t> steps;
    std::int64_t before_ns = counts.begin()->first;
    EXPECT_EQ(before_ns, kStart_ns);
    for (auto it = std::next(counts.begin()); it != counts.end(); ++it) {
      steps.insert(it->first - before_ns);
      before_ns = it->first;
    }
    EXPECT_THAT(steps, SizeIs(Le(1u))) << sweeps;
    if (steps.empty()) continue;
    EXPECT_GT(counts.rbegin()->first + *steps.begin(), kStart_ns + (sweeps - 1) * kSweep_ns);
  }
}

TEST(ScanSamplerTest, AThinnedSweepHasAsManyPointsAsAllowedFromAllRingsAlike) {
  ScanSamplingOptions options;
  options.points_per_moment = 800;
  ScanSampler sampler({}, options);
  sampler.Note(Sweep(0));
  std::vector<int> per_ring(kRings);
  const std::vector<WorldPoint> points = sampler.Deskew(Drive(0.2), {});
  for (const WorldPoint& point : points) ++per_ring[static_cast<std::size_t>(point.intensity)];
  EXPECT_THAT(points, SizeIs(800));
  EXPECT_THAT(per_ring, Each(::testing::AllOf(::testing::Ge(40), Le(60))));
}

TEST(ScanSamplerTest, FarPointsAreKeptInProportionToTheirRange) {
  LidarScan scan = Sweep(0);
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    if (i / kRings % 2 == 0) scan.points[i].xyz_m *= 5.0F;
  }
  ScanSamplingOptions options;
  options.points_per_moment = 300;
  ScanSampler sampler({}, options);
  sampler.Note(scan);
  // At rest in the world's origin, a range is a distance from there.
  Trajectory rest;
  rest.Append({kStart_ns, SE3()});
  rest.Append({kStart_ns + kSweep_ns, SE3()});
  int far = 0;
  for (const WorldPoint& point : sampler.Deskew(rest, {})) far += point.p_world_m.norm() > 20.0F;
  EXPECT_NEAR(far / 300.0, 5.0 / 6.0, 0.05);
}

TEST(ScanSamplerTest, PointsAreWhereTheyWereMeasuredAlsoWithAnExtrinsicAndATurnedBeam) {
  const std::vector<Eigen::Vector3d> posts = {{9, 2, 1}, {-7, 4, 0.5}, {1, -12, 2}};
  SegmenterOptions segmenter;
  SE3 T_body_lidar;
  T_body_lidar.q = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY());
  T_body_lidar.t = Eigen::Vector3d(0.1, -0.2, 0.3);
  LidarPlace place;
  place.T_body_lidar = T_body_lidar;
  place.clock_moved_s = 0.003;
  segmenter.vertical_correction_deg = 0.205;
  const auto too_low_rad = static_cast<float>(0.205 * M_PI / 180.0);
  LidarScan scan;
  scan.lidar_id = 1;
  for (int i = 0; i < 300; ++i) {
    LidarPoint point;
    point.t_ns = kStart_ns + i * 1'000'000;
    const SE3 T_world_lidar = PoseAt(point.t_ns + 3'000'000) * T_body_lidar;
    const Eigen::Vector3d& post = posts[static_cast<std::size_t>(i % 3)];
    point.xyz_m = TurnUp((T_world_lidar.Inverse() * post).cast<float>(), -too_low_rad);
    point.intensity = static_cast<float>(i % 3);
    scan.points.push_back(point);
  }
  ScanSampler sampler(segmenter);
  sampler.Note(scan);
  const std::vector<WorldPoint> points = sampler.Deskew(Drive(0.4), {LidarPlace(), place});
  EXPECT_THAT(points, SizeIs(300));
  for (const WorldPoint& point : points) {
    const Eigen::Vector3d& post = posts[static_cast<std::size_t>(point.intensity)];
    EXPECT_LT((point.p_world_m.cast<double>() - post).norm(), 1e-4);
  }
}

TEST(ScanSamplerTest, WhatTheEstimatorDoesNotUseIsNotShown) {
  SegmenterOptions segmenter;
  segmenter.min_range_m = 1.0;
  segmenter.max_range_m = 50.0;
  LidarScan scan = Sweep(0, 1);
  scan.points[0].xyz_m = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  scan.points[1].xyz_m *= 0.1F;
  scan.points[2].xyz_m *= 10.0F;
  scan.points[3].t_ns += 10 * kSweep_ns;  // beyond the trajectory
  ScanSampler sampler(segmenter);
  sampler.Note(scan);
  EXPECT_THAT(sampler.Deskew(Drive(0.2), {}), SizeIs(kRings - 4));
}

/// Where nobody knows how the body moved, nothing is drawn.
TEST(ScanSamplerTest, WhatWasSeenInAPauseOfTheTrajectoryIsNotShown) {
  SegmenterOptions segmenter;
  ScanSampler sampler(segmenter);
  for (int i = 0; i < 30; ++i) sampler.Note(Sweep(i, 4));
  Trajectory with_pause;
  for (const int i : {0, 5, 20, 30}) {
    const std::int64_t t_ns = kStart_ns + i * kSweep_ns;
    with_pause.Append({t_ns, PoseAt(t_ns)});
  }
  const auto counts = PointsPerMoment(sampler.Deskew(with_pause, {}));
  ASSERT_FALSE(counts.empty());
  EXPECT_EQ(counts.begin()->first, kStart_ns);
  for (const auto& [moment_ns, count] : counts) {
    const std::int64_t i = (moment_ns - kStart_ns) / kSweep_ns;
    EXPECT_TRUE(i <= 5 || i >= 20) << i;
  }
  EXPECT_EQ(counts.count(kStart_ns + 4 * kSweep_ns), 1U);
  EXPECT_EQ(counts.count(kStart_ns + 21 * kSweep_ns), 1U);
}

std::vector<float> Values(const PointTable& table, const std::string& name) {
  std::vector<float> values(table.count);
  const Column* column = table.Find(name);
  if (column == nullptr) return {};
  VisitColumn(table, *column, 0, table.count,
              [&](std::size_t i, auto value) { values[i] = static_cast<float>(value); });
  return values;
}

TEST(ViewPlyTest, HoldsPlacesIntensitiesAndTimesSinceTheFirstMoment) {
  testing::TempFolder temp;
  WriteViewPly(temp / "view.ply", {{{1.0F, 2.0F, 3.0F}, 4.0F, kStart_ns},
                                   {{-1.5F, 0.25F, 7.0F}, 90.0F, kStart_ns + 3 * kSweep_ns}});
  const PointTable table = ReadPointFile(temp / "view.ply");
  EXPECT_EQ(table.damage, "");
  EXPECT_THAT(Values(table, "x"), ElementsAre(1.0F, -1.5F));
  EXPECT_THAT(Values(table, "y"), ElementsAre(2.0F, 0.25F));
  EXPECT_THAT(Values(table, "z"), ElementsAre(3.0F, 7.0F));
  EXPECT_THAT(Values(table, "intensity"), ElementsAre(4.0F, 90.0F));
  EXPECT_THAT(Values(table, "t_s"), ElementsAre(0.0F, 0.3F));
  EXPECT_THAT(testing::ReadFile(temp / "view.ply"),
              ::testing::HasSubstr("comment begin_s 1600000000.000000000\n"));
}

}  // namespace
}  // namespace trajlo
