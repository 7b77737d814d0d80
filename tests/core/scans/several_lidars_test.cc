// SPDX-License-Identifier: MIT
// ScanSequencer with several LiDARs: whether their clocks meet, and what one tells of another.
#include <cmath>
#include <functional>

#include "tests/core/scans/sequence_scans.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Two LiDARs at 10 Hz, the scans in the order in which they were measured; the times of the second
/// are `ahead` of the truth from its scan `from` on.
std::vector<LidarScan> Rig(std::int64_t ahead, int from = 0) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 40; ++i) {
    scans.push_back(MakeScan(i, kStart + i * kPeriod, 0));
    scans.push_back(MakeScan(i, kStart + i * kPeriod + 37 * kMs + (i < from ? 0 : ahead), 1));
  }
  return scans;
}

TEST(ScanSequencer, LeavesOutALidarWhoseClockDoesNotMeetThatOfTheFirst) {
  for (const std::int64_t ahead : {kDay, -kDay, 3 * kSecond, -3 * kSecond}) {
    const Sequenced result = Sequence(Rig(ahead));
    EXPECT_EQ(result.scans.size(), 40u);
    for (const LidarScan& scan : result.scans) EXPECT_EQ(scan.lidar_id, 0);
    EXPECT_EQ(result.report.apart, 40);
    ASSERT_THAT(result.report.remarks, SizeIs(1));
    EXPECT_THAT(result.report.remarks[0],
                AllOf(HasSubstr("lidar 1"), HasSubstr("input.clock_offset_s"),
                      HasSubstr(ahead > 0 ? "ahead of" : "behind")));
  }
  // Whatever offset is set already; less than a sweep is not known.
  EXPECT_THAT(Sequence(Rig(3 * kSecond)).report.remarks,
              ::testing::ElementsAre(
                  HasSubstr("change input.clock_offset_s of this LiDAR by about -3.0 s")));
  EXPECT_EQ(Sequence(Rig(3 * kSecond), 4.0).report.apart, 0) << "within the lag that is allowed";
}

TEST(ScanSequencer, LeavesOutALidarThatOnlySpeaksWhenTheFirstHasEnded) {
  for (const std::int64_t later : {10 * kSecond, kDay}) {
    std::vector<LidarScan> scans;
    for (int i = 0; i < 40; ++i) scans.push_back(MakeScan(i, kStart + i * kPeriod, 1));
    for (int i = 0; i < 40; ++i) scans.push_back(MakeScan(i, kStart + later + i * kPeriod, 0));
    const Sequenced result = Sequence(scans);
    EXPECT_EQ(result.report.apart, 40);
  }
}

TEST(ScanSequencer, ALidarThatBeginsAndEndsLaterThanTheFirstRaisesADoubt) {
  // In the order of the stamps, as folders without times of recording are merged.
  for (const std::int64_t later : {3 * kSecond, -3 * kSecond, 0 * kSecond}) {
    for (const bool ends_later : {true, false}) {
      std::vector<LidarScan> scans;
      for (int i = 0; i < 100; ++i) {
        const std::int64_t stamp = kStart + i * kPeriod;
        scans.push_back(MakeScan(i, stamp, 0));
        if (ends_later || (stamp + later >= kStart && stamp + later < kStart + 100 * kPeriod)) {
          scans.push_back(MakeScan(i, stamp + later + 37 * kMs, 1));
        }
      }
      std::stable_sort(scans.begin(), scans.end(),
                       [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
      const Sequenced result = Sequence(scans);
      ExpectSame(result.scans, scans);
      const bool is_doubtful = ends_later && later != 0;
      EXPECT_EQ(result.report.clocks_may_differ, is_doubtful) << later;
      // One that is silent for a while at either end is reported as that.
      ASSERT_EQ(result.report.remarks.size(), later != 0 ? 1u : 0u);
      EXPECT_NEAR(result.report.longest_silence_s, later != 0 && !is_doubtful ? 3.0 : 0.0, 0.11);
      if (later == 0) continue;
      EXPECT_THAT(result.report.remarks[0],
                  is_doubtful ? HasSubstr("input.clock_offset_s")
                              : HasSubstr(later > 0 ? "lidar 1: nothing was heard of it for the "
                                                      "first 3.0"
                                                    : "lidar 1: nothing was heard of it for the "
                                                      "last "));
    }
  }
}

TEST(ScanSequencer, ALidarThatNeverGivesAPointIsSilentForTheWholeTime) {
  const auto without_points = [](LidarScan* scan) { scan->points.clear(); };
  const auto nowhere = [](LidarScan* scan) {
    for (LidarPoint& point : scan->points) point.xyz_m.setZero();
  };
  const auto not_finite = [](LidarScan* scan) {
    for (LidarPoint& point : scan->points) point.xyz_m.setConstant(NAN);
  };
  for (const int silent : {0, 1}) {
    for (const std::function<void(LidarScan*)>& take_away :
         {std::function<void(LidarScan*)>(without_points), std::function<void(LidarScan*)>(nowhere),
          std::function<void(LidarScan*)>(not_finite)}) {
      std::vector<LidarScan> scans = Rig(0);
      for (LidarScan& scan : scans) {
        if (scan.lidar_id == silent) take_away(&scan);
      }
      const TimeReport report = Sequence(scans).report;
      EXPECT_NEAR(report.longest_silence_s, 3.9, 0.1);
      EXPECT_THAT(report.remarks,
                  ::testing::Contains(HasSubstr("lidar " + std::to_string(silent) +
                                                ": nothing was heard of it for the whole 3.9")));
    }
  }
  // With no LiDAR at all to hear there is no silence of one.
  std::vector<LidarScan> scans = Rig(0);
  for (LidarScan& scan : scans) nowhere(&scan);
  EXPECT_EQ(Sequence(scans).report.longest_silence_s, 0.0);
}

TEST(ScanSequencer, LidarsThatAreNotSynchronisedRaiseADoubt) {
  for (const double drift : {0.0, 0.003, 0.01, -0.01}) {
    std::vector<LidarScan> scans = Rig(0);
    for (std::size_t i = 0; i < scans.size(); ++i) {
      LidarScan& scan = scans[i];
      const std::int64_t late_ns = (i % 5 == 0 ? 9 : 1) * kMs;
      scan.recorded_ns = scan.stamp_ns + 100 * kMs + late_ns;
      if (scan.lidar_id == 0) continue;
      ShiftTimes(std::llround(drift * static_cast<double>(scan.stamp_ns - kStart)), &scan);
    }
    const bool is_doubtful = std::abs(drift) > 0.005;  // 24 ms between the medians
    const TimeReport report = Sequence(scans).report;
    EXPECT_EQ(report.clocks_may_differ, is_doubtful) << drift;
    if (!is_doubtful) continue;
    EXPECT_THAT(report.remarks[0], AllOf(HasSubstr("lidar 1"), HasSubstr("run apart, by 0.02")));
  }
}

TEST(ScanSequencer, FirstPointsThatAreMissingAreNoDrift) {
  std::vector<LidarScan> scans = Rig(0);
  for (LidarScan& scan : scans) {
    scan.recorded_ns = scan.stamp_ns + 101 * kMs;
    const bool is_late = scan.lidar_id == 1 && NumberOf(scan) >= 20;
    if (is_late) scan.points.erase(scan.points.begin(), scan.points.begin() + 5);
  }
  EXPECT_FALSE(Sequence(scans).report.clocks_may_differ);
}

TEST(ScanSequencer, TakesALidarInWhenItsClockWasSet) {
  std::vector<LidarScan> scans = Rig(0);
  int left_out = 0;
  for (LidarScan& scan : scans) {
    const bool is_unset = scan.lidar_id == 1 && NumberOf(scan) < 15;
    if (is_unset) ShiftTimes(-kStart, &scan);
    left_out += is_unset ? 1 : 0;
  }
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.report.apart, left_out);
  EXPECT_EQ(result.scans.size(), scans.size() - static_cast<std::size_t>(left_out));
  for (const LidarScan& scan : result.scans) EXPECT_GE(scan.stamp_ns, kStart);
}

TEST(ScanSequencer, ClocksThatStepTogetherStayTogether) {
  // The host's clock steps: the scans of both LiDARs do, and keep their distance to the bit.
  std::vector<LidarScan> scans = Rig(0);
  for (LidarScan& scan : scans) {
    const std::int64_t jitter = (NumberOf(scan) * 7 + scan.lidar_id * 3) % 5 * kMs;
    ShiftTimes(jitter - (NumberOf(scan) >= 20 ? kHour : 0), &scan);
  }
  const Sequenced result = Sequence(scans);
  ASSERT_EQ(result.scans.size(), scans.size());
  EXPECT_EQ(result.report.clock_steps, 2);
  const std::int64_t moved = result.scans.back().stamp_ns - scans.back().stamp_ns;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const bool is_after = NumberOf(result.scans[i]) >= 20;
    EXPECT_EQ(result.scans[i].stamp_ns - scans[i].stamp_ns, is_after ? moved : 0) << i;
  }
}

TEST(ScanSequencer, OtherLidarsTellAPauseFromAStepOfTheClock) {
  // One that is silent for two minutes while the other goes on has made no step.
  std::vector<LidarScan> scans;
  for (int i = 0; i < 1500; ++i) {
    scans.push_back(MakeScan(i, kStart + i * kPeriod, 0));
    const bool is_silent = i >= 100 && i < 1300;
    if (!is_silent) scans.push_back(MakeScan(i, kStart + i * kPeriod + 37 * kMs, 1));
  }
  const Sequenced pause = Sequence(scans);
  ExpectSame(pause.scans, scans);
  ExpectNothingDone(pause.report);
  // One that jumps ahead by three seconds while the other does not has.
  const Sequenced step = Sequence(Rig(3 * kSecond, 20));
  EXPECT_EQ(step.report.clock_steps, 1);
  EXPECT_EQ(step.scans.size(), 80u);
  for (const LidarScan& scan : step.scans) {
    EXPECT_EQ(scan.stamp_ns, kStart + NumberOf(scan) * kPeriod + 37 * kMs * scan.lidar_id);
  }
}

}  // namespace
}  // namespace trajlo::testing
