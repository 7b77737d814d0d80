// SPDX-License-Identifier: MIT
// ScanSequencer where stamps are wrong, repeated, standing still or running backwards.
#include <limits>

#include "tests/core/scans/sequence_scans.h"

namespace trajlo::testing {
namespace {

TEST(ScanSequencer, GivesAScanWithAWrongStampThePlaceThatIsFree) {
  for (const std::int64_t wrong :
       {5 * kDay, -5 * kDay, 2 * kSecond, -2 * kSecond, kSecond / 2, kPeriod, -kPeriod,
        -20 * kMs - kPeriod, std::numeric_limits<std::int64_t>::max() / 4}) {
    for (const int at : {6, 7, 20, 36}) {
      std::vector<std::int64_t> stamps = Regular(40);
      stamps[static_cast<std::size_t>(at)] += wrong;
      const Sequenced result = SequenceStamps(stamps);
      ASSERT_EQ(result.scans.size(), 40u) << wrong << " at " << at;
      EXPECT_EQ(result.LargestError(), 0) << wrong << " at " << at;
      EXPECT_EQ(result.report.retimed, 1) << wrong << " at " << at;
      EXPECT_EQ(result.report.clock_steps, 0);
    }
  }
}

TEST(ScanSequencer, DropsAScanWithAWrongStampAtTheStartOrTheEnd) {
  for (const std::int64_t wrong :
       {5 * kDay, -5 * kDay, 2 * kSecond, -kStart, 500 * kMs, -500 * kMs, -250 * kMs}) {
    for (const int at : {0, 39}) {
      std::vector<std::int64_t> stamps = Regular(40);
      stamps[static_cast<std::size_t>(at)] += wrong;
      const Sequenced result = SequenceStamps(stamps);
      EXPECT_EQ(result.scans.size(), 39u) << wrong << " at " << at;
      EXPECT_EQ(result.LargestError(), 0);
      EXPECT_EQ(result.report.Dropped(), 1);
      EXPECT_EQ(result.report.points, 10);
    }
  }
}

TEST(ScanSequencer, OfTwoStampsThatContradictEachOtherTheOneOutOfStepIsWrong) {
  // A scan is lost, and the second one after it has the stamp of the first, or one before it.
  for (const std::int64_t wrong : {-kPeriod, -kPeriod - 20 * kMs, -kPeriod - 40 * kMs}) {
    for (const int at : {8, 20, 35}) {
      std::vector<LidarScan> scans = WithStamps(Regular(40));
      ShiftTimes(wrong, &scans[static_cast<std::size_t>(at)]);
      scans.erase(scans.begin() + at - 2);
      const Sequenced result = Sequence(scans);
      EXPECT_EQ(result.scans.size(), 39u) << wrong << " at " << at;
      EXPECT_EQ(result.LargestError(), 0) << wrong << " at " << at;
      EXPECT_EQ(result.report.retimed, 1) << wrong << " at " << at;
    }
  }
}

TEST(ScanSequencer, OfTwoCopiesOfStampsInARowBothGetTheirPlaces) {
  for (const std::size_t at : {8u, 20u, 35u}) {
    std::vector<std::int64_t> stamps = Regular(40);
    stamps[at] = stamps[at - 1];
    stamps[at + 2] = stamps[at + 1];
    const Sequenced result = SequenceStamps(stamps);
    EXPECT_EQ(result.scans.size(), 40u) << at;
    EXPECT_EQ(result.LargestError(), 0) << at;
    EXPECT_EQ(result.report.retimed, 2) << at;
  }
}

TEST(ScanSequencer, AScanThatComesTwiceBehindALostOneDoesNotTakeItsPlace) {
  for (const int at : {8, 20, 35}) {
    std::vector<LidarScan> scans = WithStamps(Regular(40));
    scans[static_cast<std::size_t>(at - 1)] = scans[static_cast<std::size_t>(at)];
    const Sequenced result = Sequence(scans);
    EXPECT_EQ(result.scans.size(), 39u) << at;
    EXPECT_EQ(result.LargestError(), 0) << at;
    EXPECT_EQ(result.report.repeated, 1) << at;
  }
}

TEST(ScanSequencer, DropsAWrongStampWhereSeveralPlacesAreFree) {
  std::vector<std::int64_t> stamps = Regular(40);
  stamps[20] += kHour;
  stamps.erase(stamps.begin() + 21, stamps.begin() + 23);
  const Sequenced result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 37u);
  EXPECT_EQ(result.report.misfits, 1);
}

TEST(ScanSequencer, GivesRepeatedStampsTheirOwnTime) {
  std::vector<std::int64_t> stamps = Regular(40);
  for (const std::size_t i : {10, 20, 21, 30}) stamps[i] = stamps[i - 1];
  const Sequenced result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 40u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.retimed, 4);
}

TEST(ScanSequencer, DropsScansThatComeTwice) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  scans.insert(scans.begin() + 11, scans[10]);
  scans[20] = scans[12];  // In place of another.
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 29u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.repeated, 2);
}

TEST(ScanSequencer, StampsThatStandStillGoOnByTheLengthOfASweep) {
  const Sequenced all = SequenceStamps(std::vector<std::int64_t>(40, kStart));
  ASSERT_EQ(all.scans.size(), 40u);
  EXPECT_EQ(all.report.assumed, 39);
  for (std::size_t i = 1; i < 40; ++i) {
    EXPECT_EQ(all.scans[i].stamp_ns - all.scans[i - 1].stamp_ns, 90 * kMs);
  }
  std::vector<std::int64_t> stamps = Regular(60);
  for (std::size_t i = 21; i < 45; ++i) stamps[i] = stamps[20];
  const Sequenced some = SequenceStamps(stamps);
  EXPECT_EQ(some.scans.size(), 60u);
  EXPECT_EQ(some.LargestError(), 0);
  EXPECT_EQ(some.report.assumed + some.report.retimed, 24);
}

TEST(ScanSequencer, StampsThatStandStillWithoutPointTimesAreDropped) {
  std::vector<LidarScan> scans = WithStamps(std::vector<std::int64_t>(40, kStart));
  for (LidarScan& scan : scans) scan.has_point_times = false;
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 1u);
  EXPECT_EQ(result.report.repeated, 39);
}

TEST(ScanSequencer, StampsThatRunBackwardsAreDropped) {
  std::vector<std::int64_t> stamps = Regular(40);
  std::reverse(stamps.begin(), stamps.end());
  const Sequenced result = SequenceStamps(stamps);
  EXPECT_LE(result.scans.size(), 1u);
  EXPECT_GE(result.report.Dropped(), 39);
}

}  // namespace
}  // namespace trajlo::testing
