// SPDX-License-Identifier: MIT
// ScanSequencer where a clock steps, or seems to.
#include "tests/core/scans/sequence_scans.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

TEST(ScanSequencer, TwoWrongStampsInARowAreNoStepOfTheClock) {
  std::vector<std::int64_t> stamps = Regular(40);
  stamps[20] += 5 * kDay;
  stamps[21] += 5 * kDay;
  const Sequenced result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 40u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.clock_steps, 0);
}

TEST(ScanSequencer, FollowsAStepOfTheClockThatLasts) {
  // Back by a little less than a period, the first scan behind the step still lies ahead.
  for (const std::int64_t step : {kHour, -kHour, -2 * kSecond, -3 * kPeriod, -kPeriod + kMs,
                                  -kPeriod + 5 * kMs, 30 * kDay, -kStart}) {
    for (const int at : {5, 20, 33}) {
      std::vector<std::int64_t> stamps = Regular(40);
      for (std::size_t i = static_cast<std::size_t>(at); i < 40; ++i) stamps[i] += step;
      const Sequenced result = SequenceStamps(stamps);
      EXPECT_EQ(result.scans.size(), 40u) << step << " at " << at;
      EXPECT_EQ(result.LargestError(), 0) << step << " at " << at;
      EXPECT_EQ(result.report.clock_steps, 1);
      EXPECT_EQ(result.report.moved, 40 - at);
      ASSERT_THAT(result.report.remarks, SizeIs(1));
      EXPECT_THAT(result.report.remarks[0],
                  AllOf(HasSubstr("lidar 0"), HasSubstr(step > 0 ? "steps ahead" : "steps back")));
    }
  }
}

TEST(ScanSequencer, AClockThatStepsBackToWhereItWasIsExactlyThere) {
  // Ahead by an hour is no pause; by less it would be one, if the clock had not stepped before.
  for (const std::int64_t step : {kHour, 30 * kSecond, kSecond, 5 * kPeriod}) {
    std::vector<std::int64_t> stamps = Regular(60);
    for (std::size_t i = 20; i < 40; ++i) stamps[i] -= step;
    for (std::size_t i = 40; i < 60; ++i) stamps[i] += 3 * kMs;
    const Sequenced result = SequenceStamps(stamps);
    ASSERT_EQ(result.scans.size(), 60u);
    EXPECT_EQ(result.report.clock_steps, 2) << step;
    for (std::size_t i = 40; i < 60; ++i) EXPECT_EQ(result.scans[i].stamp_ns, stamps[i]) << step;
  }
}

TEST(ScanSequencer, FirstScansFromBeforeTheClockWasSetLieBeforeTheOthers) {
  for (const int count : {2, 3, 4}) {
    for (const std::int64_t step : {kStart, kDay, -kHour, -2 * kSecond}) {
      std::vector<std::int64_t> stamps = Regular(40);
      for (int i = 0; i < count; ++i) stamps[static_cast<std::size_t>(i)] -= step;
      const Sequenced result = SequenceStamps(stamps);
      EXPECT_EQ(result.scans.size(), 40u) << count << " by " << step;
      EXPECT_EQ(result.LargestError(), 0) << count << " by " << step;
      EXPECT_EQ(result.report.moved, count);
      ASSERT_THAT(result.report.remarks, SizeIs(1));
      EXPECT_THAT(result.report.remarks[0], HasSubstr("the times before were moved"));
    }
  }
}

TEST(ScanSequencer, APauseAmongTheFirstScansIsStillAPause) {
  for (const std::int64_t pause : {kSecond, 50 * kSecond}) {
    std::vector<std::int64_t> stamps = Regular(40);
    for (std::size_t i = 3; i < 40; ++i) stamps[i] += pause;
    const Sequenced result = SequenceStamps(stamps);
    ASSERT_EQ(result.scans.size(), 40u);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(result.scans[i].stamp_ns, stamps[i]) << i;
    ExpectNothingDone(result.report);
  }
}

TEST(ScanSequencer, SwappedScansAmongTheFirstAreNoStepOfTheClock) {
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  std::swap(scans[1], scans[2]);
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.moved + result.report.clock_steps, 0);
}

TEST(ScanSequencer, APauseAfterAStepOfTheClockIsStillAPause) {
  for (const std::int64_t pause : {kSecond, 10 * kSecond, 50 * kSecond}) {
    std::vector<std::int64_t> stamps = Regular(60);
    for (std::size_t i = 20; i < 60; ++i) stamps[i] -= 30 * kSecond;
    for (std::size_t i = 40; i < 60; ++i) stamps[i] += pause;
    const Sequenced result = SequenceStamps(stamps);
    ASSERT_EQ(result.scans.size(), 60u);
    EXPECT_EQ(result.report.clock_steps, 1) << pause;
    EXPECT_EQ(result.scans[59].stamp_ns, stamps[59] + 30 * kSecond) << pause;
  }
}

TEST(ScanSequencer, AStepOfAClockThatWaitsForItsTimeIsTakenBackByTheTimesOfRecording) {
  for (const std::int64_t pause : {5 * kSecond, 37 * kSecond, 2 * kHour}) {
    for (const bool is_step : {true, false}) {
      std::vector<LidarScan> scans = WithStamps(Regular(40));
      for (std::size_t i = 0; i < 40; ++i) {
        // Late by 2 ms now and then.
        scans[i].recorded_ns = scans[i].stamp_ns + 101 * kMs + (i % 3 == 0 ? 2 * kMs : 0);
        if (i < 20) continue;
        ShiftTimes(pause, &scans[i]);
        if (!is_step) *scans[i].recorded_ns += pause;
      }
      const Sequenced result = Sequence(scans);
      ASSERT_EQ(result.scans.size(), 40u);
      EXPECT_EQ(result.report.clock_steps, is_step ? 1 : 0) << pause;
      EXPECT_EQ(result.LargestError(), is_step ? 0 : pause);
    }
  }
}

TEST(ScanSequencer, TimesOfRecordingThatCopyTheStampsProveNothing) {
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  for (std::size_t i = 0; i < 40; ++i) {
    if (i >= 20) ShiftTimes(kHour, &scans[i]);
    scans[i].recorded_ns = scans[i].stamp_ns;
  }
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.report.clock_steps, 1);
  EXPECT_EQ(result.LargestError(), 0);
}

TEST(ScanSequencer, TimesOfRecordingThatStandStillProveNothing) {
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  for (std::size_t i = 0; i < 40; ++i) {
    if (i >= 20) ShiftTimes(5 * kSecond, &scans[i]);
    scans[i].recorded_ns = 0;
  }
  const Sequenced result = Sequence(scans);
  ExpectSame(result.scans, scans);
}

}  // namespace
}  // namespace trajlo::testing
