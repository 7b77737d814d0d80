// SPDX-License-Identifier: MIT
#include "core/report/trajectory_sampler.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

/// A trajectory that moves along x with 1 m/s, a pose every 30 ms from 1 s on.
void Grow(Trajectory* trajectory, int poses) {
  for (int i = 0; i < poses; ++i) {
    const auto k = static_cast<std::int64_t>(trajectory->poses().size());
    ControlPose pose;
    pose.t_ns = 1000 * kMs + 30 * kMs * k;
    pose.T_world_body.t.x() = 0.03 * static_cast<double>(k);
    trajectory->Append(pose);
  }
}

LidarScan ScanFrom(std::int64_t begin_ms, int lidar_id = 0) {
  LidarScan scan;
  scan.lidar_id = lidar_id;
  scan.stamp_ns = begin_ms * kMs;
  scan.points.resize(3);
  // Unordered in time, as the columns of some drivers are.
  scan.points[0].t_ns = scan.stamp_ns + 100 * kMs;
  scan.points[1].t_ns = scan.stamp_ns;
  scan.points[2].t_ns = scan.stamp_ns + 50 * kMs;
  return scan;
}

class TrajectorySamplerTest : public ::testing::Test {
 protected:
  TrajectorySampler::Visit Collect() {
    return [this](std::int64_t t_ns, const SE3& T) {
      times_ms_.push_back(t_ns / kMs);
      EXPECT_NEAR(T.t.x(), 1e-9 * static_cast<double>(t_ns) - 1.0, 1.1e-3);
      return times_ms_.size() < most_;
    };
  }
  Trajectory trajectory_;
  std::vector<std::int64_t> times_ms_;
  std::size_t most_ = 1'000'000;  ///< Then the visitor has had enough.
};

TEST_F(TrajectorySamplerTest, ControlPosesAreWrittenOnceAsTheyCome) {
  TrajectorySampler sampler({});
  sampler.Advance(trajectory_, Collect());
  EXPECT_THAT(times_ms_, IsEmpty());
  Grow(&trajectory_, 2);
  sampler.Advance(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1000, 1030));
  Grow(&trajectory_, 1);
  sampler.Advance(trajectory_, Collect());
  sampler.Finish(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1000, 1030, 1060));
  EXPECT_EQ(sampler.written(), 3u);
}

TEST_F(TrajectorySamplerTest, RateGivesEvenTimesWhateverTheSteps) {
  TrajectorySampler all_at_once({SampleAt::kRate, 50.0}), step_by_step({SampleAt::kRate, 50.0});
  for (int i = 0; i < 5; ++i) {
    Grow(&trajectory_, 1);
    step_by_step.Advance(trajectory_, Collect());
  }
  EXPECT_THAT(times_ms_, ElementsAre(1000, 1020, 1040, 1060, 1080, 1100, 1120));
  times_ms_.clear();
  all_at_once.Finish(trajectory_, Collect());
  EXPECT_EQ(times_ms_.size(), 7u);
}

TEST_F(TrajectorySamplerTest, RateDoesNotDrift) {
  Grow(&trajectory_, 1001);  // 30 s
  std::int64_t last = 0;
  TrajectorySampler sampler({SampleAt::kRate, 3.0});
  sampler.Finish(trajectory_, [&](std::int64_t t_ns, const SE3&) {
    last = t_ns;
    return true;
  });
  EXPECT_EQ(last, 31'000 * kMs);
}

/// A pose `later` than the last one.
void Jump(Trajectory* trajectory, std::int64_t later_ns) {
  ControlPose pose = trajectory->poses().back();
  pose.t_ns += later_ns;
  pose.T_world_body.t.x() += 1e-9 * static_cast<double>(later_ns);
  trajectory->Append(pose);
}

TEST_F(TrajectorySamplerTest, RateGivesNoPosesInAGap) {
  for (const bool step_by_step : {true, false}) {
    TrajectorySampler sampler({SampleAt::kRate, 50.0, 1.0});
    trajectory_ = {};
    times_ms_.clear();
    Grow(&trajectory_, 3);  // Until 1.060 s.
    if (step_by_step) sampler.Advance(trajectory_, Collect());
    Jump(&trajectory_, 1'000 * kMs);  // Not longer than a gap.
    if (step_by_step) sampler.Advance(trajectory_, Collect());
    EXPECT_EQ(sampler.written(), step_by_step ? 54u : 0u);
    const std::int64_t years_ns = 50LL * 365 * 24 * 3600 * 1'000'000'000;
    Jump(&trajectory_, years_ns + 5 * kMs);
    Jump(&trajectory_, 40 * kMs);
    sampler.Finish(trajectory_, Collect());
    ASSERT_EQ(times_ms_.size(), 56u);
    EXPECT_EQ(times_ms_[53], 2060);
    EXPECT_EQ(times_ms_[54] - years_ns / kMs, 2080);
    EXPECT_EQ(times_ms_[55] - years_ns / kMs, 2100);
  }
}

TEST_F(TrajectorySamplerTest, AVisitorThatHasHadEnoughIsGivenTheRestLater) {
  for (const SampleAt at : {SampleAt::kRate, SampleAt::kControlPoses}) {
    TrajectorySampler sampler({at, 1.0 / 0.03, 1.0});
    trajectory_ = {};
    times_ms_.clear();
    Grow(&trajectory_, 5);
    most_ = 2;
    sampler.Advance(trajectory_, Collect());
    EXPECT_THAT(times_ms_, ElementsAre(1000, 1030));
    most_ = 100;
    sampler.Finish(trajectory_, Collect());
    EXPECT_THAT(times_ms_, ElementsAre(1000, 1030, 1060, 1090, 1120));
    EXPECT_EQ(sampler.written(), 5u);
  }
}

TEST_F(TrajectorySamplerTest, OnePosePerScanOfTheFirstLidar) {
  TrajectorySampler end({SampleAt::kScanEnd, 0.0}), mid({SampleAt::kScanMid, 0.0});
  for (TrajectorySampler* sampler : {&end, &mid}) {
    sampler->NoteScan(ScanFrom(1000));
    sampler->NoteScan(ScanFrom(1020, 1));
    sampler->NoteScan(ScanFrom(1100));
  }
  Grow(&trajectory_, 8);  // Until 1.210 s.
  end.Advance(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1100, 1200));
  times_ms_.clear();
  mid.Advance(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1050, 1150));
}

TEST_F(TrajectorySamplerTest, ScansWithoutPointTimesStandAtTheirStamps) {
  TrajectorySampler sampler({SampleAt::kScanEnd, 0.0});
  LidarScan scan = ScanFrom(1010);
  scan.has_point_times = false;
  sampler.NoteScan(scan);
  Grow(&trajectory_, 3);
  sampler.Finish(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1010));
}

TEST_F(TrajectorySamplerTest, RepeatedAndUncoveredScansAreCounted) {
  TrajectorySampler sampler({SampleAt::kScanEnd, 0.0});
  for (const int begin_ms : {800, 1000, 1000, 5000}) sampler.NoteScan(ScanFrom(begin_ms));
  Grow(&trajectory_, 5);
  sampler.Finish(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1100));
  EXPECT_EQ(sampler.scans_without_pose(), 3u);
}

TEST_F(TrajectorySamplerTest, LastScanMayEndAMomentAfterTheLastPose) {
  TrajectorySampler sampler({SampleAt::kScanEnd, 0.0});
  Grow(&trajectory_, 5);  // Until 1.120 s.
  LidarScan scan = ScanFrom(1020);
  scan.points[0].t_ns += kMs / 2;
  sampler.NoteScan(scan);
  sampler.Finish(trajectory_, Collect());
  EXPECT_THAT(times_ms_, ElementsAre(1120));
  EXPECT_EQ(sampler.scans_without_pose(), 0u);
}

}  // namespace
}  // namespace trajlo
