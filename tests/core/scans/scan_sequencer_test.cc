// SPDX-License-Identifier: MIT
#include "core/scans/scan_sequencer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/odometry/segments/segmenter.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kPeriod = 100 * kMs;
constexpr std::int64_t kSecond = 1'000 * kMs;
constexpr std::int64_t kHour = 3600 * kSecond;
constexpr std::int64_t kDay = 24 * kHour;
constexpr std::int64_t kStart = 1'700'000'000 * kSecond;

/// A sweep whose content tells its number; ten points over 90 ms.
LidarScan MakeScan(int number, std::int64_t stamp_ns, int lidar = 0) {
  LidarScan scan;
  scan.lidar_id = lidar;
  scan.stamp_ns = stamp_ns;
  for (int i = 0; i < 10; ++i) {
    scan.points.push_back({{1.0F + static_cast<float>(number), static_cast<float>(i), 0.0F},
                           0.0F,
                           stamp_ns + i * 10 * kMs});
  }
  return scan;
}

int NumberOf(const LidarScan& scan) { return static_cast<int>(scan.points[0].xyz_m.x()) - 1; }

/// Stamps of a LiDAR at 10 Hz.
std::vector<std::int64_t> Regular(int count) {
  std::vector<std::int64_t> stamps;
  for (int i = 0; i < count; ++i) stamps.push_back(kStart + i * kPeriod);
  return stamps;
}

struct Result {
  std::vector<LidarScan> scans;
  TimeReport report;

  std::vector<int> Numbers() const {
    std::vector<int> numbers;
    for (const LidarScan& scan : scans) numbers.push_back(NumberOf(scan));
    return numbers;
  }
  /// How far the stamps are from those of the undisturbed recording, the largest, ns.
  std::int64_t LargestError() const {
    std::int64_t largest = 0;
    for (const LidarScan& scan : scans) {
      const std::int64_t truth = kStart + NumberOf(scan) * kPeriod;
      largest = std::max(largest, std::abs(scan.stamp_ns - truth));
      largest = std::max(largest, std::abs(scan.points[0].t_ns - truth));
    }
    return largest;
  }
};

Result Sequence(const std::vector<LidarScan>& scans, double max_lag_s = 0.5) {
  Result result;
  ScanSequencer sequencer(max_lag_s, [&](const LidarScan& scan) { result.scans.push_back(scan); });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  sequencer.Finish();
  result.report = sequencer.report();
  return result;
}

std::vector<LidarScan> WithStamps(const std::vector<std::int64_t>& stamps) {
  std::vector<LidarScan> scans;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    scans.push_back(MakeScan(static_cast<int>(i), stamps[i]));
  }
  return scans;
}

Result SequenceStamps(const std::vector<std::int64_t>& stamps) {
  return Sequence(WithStamps(stamps));
}

void ExpectSame(const std::vector<LidarScan>& a, const std::vector<LidarScan>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].lidar_id, b[i].lidar_id) << i;
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns) << i;
    ASSERT_EQ(a[i].points.size(), b[i].points.size()) << i;
    for (std::size_t k = 0; k < a[i].points.size(); ++k) {
      EXPECT_EQ(a[i].points[k].t_ns, b[i].points[k].t_ns) << i;
      EXPECT_EQ(a[i].points[k].xyz_m, b[i].points[k].xyz_m) << i;
    }
  }
}

void ExpectNothingDone(const TimeReport& report) {
  EXPECT_EQ(report.reordered + report.retimed + report.assumed + report.moved + report.Dropped() +
                report.clock_steps + report.odd_point_times,
            0);
  EXPECT_EQ(report.points, 0);
  EXPECT_THAT(report.remarks, IsEmpty());
}

TEST(ScanSequencer, ChangesNothingWhereTimesIncrease) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const int lidars = 1 + static_cast<int>(seed % 3);
    const double jitter = uniform(0.0, 0.9), lost = uniform(0.0, 0.6);
    std::vector<LidarScan> scans;
    std::int64_t base = kStart;
    for (int i = 0; i < 80; ++i) {
      // Pauses are of the whole rig.
      base += kPeriod +
              (i > 20 && i < 60 && uniform(0, 1) < 0.05 ? std::llround(uniform(0.5e9, 18e9)) : 0);
      for (int lidar = 0; lidar < lidars; ++lidar) {
        // Nobody can tell a lone scan before the first pause, or after the last, from a wrong
        // stamp.
        if (i > 3 && i < 77 && uniform(0, 1) < lost) continue;
        const std::int64_t stamp =
            base + lidar * 37 * kMs + std::llround(jitter * uniform(0.0, 1.0) * 0.99 * kPeriod);
        scans.push_back(MakeScan(i, stamp, lidar));
        scans.back().has_point_times = seed % 5 != 0;
      }
    }
    const Result result = Sequence(scans);
    ExpectSame(result.scans, scans);
    ExpectNothingDone(result.report);
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(ScanSequencer, HandsOnAtOnceAfterTheStart) {
  int out = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) { ++out; });
  for (int i = 0; i < 30; ++i) {
    sequencer.Add(MakeScan(i, kStart + i * kPeriod));
    EXPECT_EQ(out, i < 4 ? 0 : i + 1);
  }
}

TEST(ScanSequencer, GivesAScanWithAWrongStampThePlaceThatIsFree) {
  for (const std::int64_t wrong :
       {5 * kDay, -5 * kDay, 2 * kSecond, -2 * kSecond, kSecond / 2, kPeriod, -kPeriod,
        -20 * kMs - kPeriod, std::numeric_limits<std::int64_t>::max() / 4}) {
    for (const int at : {6, 7, 20, 36}) {
      std::vector<std::int64_t> stamps = Regular(40);
      stamps[static_cast<std::size_t>(at)] += wrong;
      const Result result = SequenceStamps(stamps);
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
      const Result result = SequenceStamps(stamps);
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
      const Result result = Sequence(scans);
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
    const Result result = SequenceStamps(stamps);
    EXPECT_EQ(result.scans.size(), 40u) << at;
    EXPECT_EQ(result.LargestError(), 0) << at;
    EXPECT_EQ(result.report.retimed, 2) << at;
  }
}

TEST(ScanSequencer, AScanThatComesTwiceBehindALostOneDoesNotTakeItsPlace) {
  for (const int at : {8, 20, 35}) {
    std::vector<LidarScan> scans = WithStamps(Regular(40));
    scans[static_cast<std::size_t>(at - 1)] = scans[static_cast<std::size_t>(at)];
    const Result result = Sequence(scans);
    EXPECT_EQ(result.scans.size(), 39u) << at;
    EXPECT_EQ(result.LargestError(), 0) << at;
    EXPECT_EQ(result.report.repeated, 1) << at;
  }
}

TEST(ScanSequencer, DropsAWrongStampWhereSeveralPlacesAreFree) {
  std::vector<std::int64_t> stamps = Regular(40);
  stamps[20] += kHour;
  stamps.erase(stamps.begin() + 21, stamps.begin() + 23);
  const Result result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 37u);
  EXPECT_EQ(result.report.misfits, 1);
}

TEST(ScanSequencer, TwoWrongStampsInARowAreNoStepOfTheClock) {
  std::vector<std::int64_t> stamps = Regular(40);
  stamps[20] += 5 * kDay;
  stamps[21] += 5 * kDay;
  const Result result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 40u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.clock_steps, 0);
}

TEST(ScanSequencer, FollowsAStepOfTheClockThatLasts) {
  for (const std::int64_t step : {kHour, -kHour, -2 * kSecond, -3 * kPeriod, 30 * kDay, -kStart}) {
    for (const int at : {5, 20, 33}) {
      std::vector<std::int64_t> stamps = Regular(40);
      for (std::size_t i = static_cast<std::size_t>(at); i < 40; ++i) stamps[i] += step;
      const Result result = SequenceStamps(stamps);
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
    const Result result = SequenceStamps(stamps);
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
      const Result result = SequenceStamps(stamps);
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
    const Result result = SequenceStamps(stamps);
    ASSERT_EQ(result.scans.size(), 40u);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(result.scans[i].stamp_ns, stamps[i]) << i;
    ExpectNothingDone(result.report);
  }
}

TEST(ScanSequencer, SwappedScansAmongTheFirstAreNoStepOfTheClock) {
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  std::swap(scans[1], scans[2]);
  const Result result = Sequence(scans);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.moved + result.report.clock_steps, 0);
}

TEST(ScanSequencer, CountsScansWhosePointsHaveOneTimeWhereThoseOfOthersHaveMore) {
  const auto count = [](int first, int last) {
    std::vector<LidarScan> scans = WithStamps(Regular(40));
    for (int i = first; i < last; ++i) {
      LidarScan& scan = scans[static_cast<std::size_t>(i)];
      for (LidarPoint& point : scan.points) point.t_ns = scan.stamp_ns;
    }
    return Sequence(scans).report.odd_point_times;
  };
  EXPECT_EQ(count(0, 0), 0);
  EXPECT_EQ(count(10, 17), 7);
  EXPECT_EQ(count(2, 36), 6);  // It is not known which are wrong.
  EXPECT_EQ(count(0, 40), 0);  // A sensor that sees all at once.
}

TEST(ScanSequencer, APauseAfterAStepOfTheClockIsStillAPause) {
  for (const std::int64_t pause : {kSecond, 10 * kSecond, 50 * kSecond}) {
    std::vector<std::int64_t> stamps = Regular(60);
    for (std::size_t i = 20; i < 60; ++i) stamps[i] -= 30 * kSecond;
    for (std::size_t i = 40; i < 60; ++i) stamps[i] += pause;
    const Result result = SequenceStamps(stamps);
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
      const Result result = Sequence(scans);
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
  const Result result = Sequence(scans);
  EXPECT_EQ(result.report.clock_steps, 1);
  EXPECT_EQ(result.LargestError(), 0);
}

TEST(ScanSequencer, TimesOfRecordingThatStandStillProveNothing) {
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  for (std::size_t i = 0; i < 40; ++i) {
    if (i >= 20) ShiftTimes(5 * kSecond, &scans[i]);
    scans[i].recorded_ns = 0;
  }
  const Result result = Sequence(scans);
  ExpectSame(result.scans, scans);
}

TEST(ScanSequencer, PutsScansInOrder) {
  for (const int from : {0, 1, 7}) {
    std::vector<LidarScan> scans = WithStamps(Regular(41));
    for (std::size_t i = static_cast<std::size_t>(from); i + 1 < scans.size(); i += 2) {
      std::swap(scans[i], scans[i + 1]);
    }
    const Result result = Sequence(scans);
    EXPECT_EQ(result.scans.size(), 41u) << from;
    EXPECT_TRUE(
        std::is_sorted(result.scans.begin(), result.scans.end(),
                       [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; }));
    EXPECT_EQ(result.LargestError(), 0);
    EXPECT_GE(result.report.reordered, from == 7 ? 17 : 15);
    EXPECT_EQ(result.report.Dropped() + result.report.retimed, 0);
  }
}

TEST(ScanSequencer, AScanThatIsLateByTwoStillComesInItsTurn) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  std::rotate(scans.begin() + 15, scans.begin() + 16, scans.begin() + 18);
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 30u);
  EXPECT_EQ(result.Numbers()[15], 15);
  EXPECT_EQ(result.report.reordered, 2);
}

TEST(ScanSequencer, AScanThatIsTooLateIsDropped) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  std::rotate(scans.begin() + 10, scans.begin() + 11, scans.begin() + 18);
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 29u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.Dropped(), 1);
}

TEST(ScanSequencer, GivesRepeatedStampsTheirOwnTime) {
  std::vector<std::int64_t> stamps = Regular(40);
  for (const std::size_t i : {10, 20, 21, 30}) stamps[i] = stamps[i - 1];
  const Result result = SequenceStamps(stamps);
  EXPECT_EQ(result.scans.size(), 40u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.retimed, 4);
}

TEST(ScanSequencer, ScansOfADriverThatHangsAreDropped) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(MakeScan(i, kStart + i * kPeriod));
  for (int i = 9; i < 14; ++i)
    scans[static_cast<std::size_t>(i)] = MakeScan(8, kStart + i * kPeriod);
  const Result result = Sequence(scans);
  EXPECT_EQ(result.report.stuck, 5);
  EXPECT_EQ(result.report.points, 50);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_THAT(result.scans, SizeIs(15));
}

TEST(ScanSequencer, ASensorWithoutNoiseMayRestAtTheStart) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(MakeScan(std::max(i - 9, 0), kStart + i * kPeriod));
  const Result result = Sequence(scans);
  EXPECT_EQ(result.report.stuck, 0);
  EXPECT_THAT(result.scans, SizeIs(20));
}

TEST(ScanSequencer, ScansWithoutAnyReturnAreNotStuck) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(MakeScan(i, kStart + i * kPeriod));
  for (int i = 9; i < 14; ++i) {
    for (LidarPoint& point : scans[static_cast<std::size_t>(i)].points) point.xyz_m.setZero();
  }
  EXPECT_EQ(Sequence(scans).report.stuck, 0);
}

TEST(ScanSequencer, DropsScansThatComeTwice) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  scans.insert(scans.begin() + 11, scans[10]);
  scans[20] = scans[12];  // In place of another.
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 29u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.repeated, 2);
}

TEST(ScanSequencer, StampsThatStandStillGoOnByTheLengthOfASweep) {
  const Result all = SequenceStamps(std::vector<std::int64_t>(40, kStart));
  ASSERT_EQ(all.scans.size(), 40u);
  EXPECT_EQ(all.report.assumed, 39);
  for (std::size_t i = 1; i < 40; ++i) {
    EXPECT_EQ(all.scans[i].stamp_ns - all.scans[i - 1].stamp_ns, 90 * kMs);
  }
  std::vector<std::int64_t> stamps = Regular(60);
  for (std::size_t i = 21; i < 45; ++i) stamps[i] = stamps[20];
  const Result some = SequenceStamps(stamps);
  EXPECT_EQ(some.scans.size(), 60u);
  EXPECT_EQ(some.LargestError(), 0);
  EXPECT_EQ(some.report.assumed + some.report.retimed, 24);
}

TEST(ScanSequencer, StampsThatStandStillWithoutPointTimesAreDropped) {
  std::vector<LidarScan> scans = WithStamps(std::vector<std::int64_t>(40, kStart));
  for (LidarScan& scan : scans) scan.has_point_times = false;
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 1u);
  EXPECT_EQ(result.report.repeated, 39);
}

TEST(ScanSequencer, StampsThatRunBackwardsAreDropped) {
  std::vector<std::int64_t> stamps = Regular(40);
  std::reverse(stamps.begin(), stamps.end());
  const Result result = SequenceStamps(stamps);
  EXPECT_LE(result.scans.size(), 1u);
  EXPECT_GE(result.report.Dropped(), 39);
}

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
    const Result result = Sequence(Rig(ahead));
    EXPECT_EQ(result.scans.size(), 40u);
    for (const LidarScan& scan : result.scans) EXPECT_EQ(scan.lidar_id, 0);
    EXPECT_EQ(result.report.apart, 40);
    ASSERT_THAT(result.report.remarks, SizeIs(1));
    EXPECT_THAT(result.report.remarks[0],
                AllOf(HasSubstr("lidar 1"), HasSubstr("input.clock_offset_s"),
                      HasSubstr(ahead > 0 ? "ahead of" : "behind")));
  }
  EXPECT_EQ(Sequence(Rig(3 * kSecond), 4.0).report.apart, 0) << "within the lag that is allowed";
}

TEST(ScanSequencer, LeavesOutALidarThatOnlySpeaksWhenTheFirstHasEnded) {
  for (const std::int64_t later : {10 * kSecond, kDay}) {
    std::vector<LidarScan> scans;
    for (int i = 0; i < 40; ++i) scans.push_back(MakeScan(i, kStart + i * kPeriod, 1));
    for (int i = 0; i < 40; ++i) scans.push_back(MakeScan(i, kStart + later + i * kPeriod, 0));
    const Result result = Sequence(scans);
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
      const Result result = Sequence(scans);
      ExpectSame(result.scans, scans);
      const bool is_doubtful = ends_later && later != 0;
      EXPECT_EQ(result.report.clocks_may_differ, is_doubtful) << later;
      ASSERT_EQ(result.report.remarks.size(), is_doubtful ? 1u : 0u);
      if (is_doubtful) {
        EXPECT_THAT(result.report.remarks[0], HasSubstr("input.clock_offset_s"));
      }
    }
  }
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
  const Result result = Sequence(scans);
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
  const Result result = Sequence(scans);
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
  const Result pause = Sequence(scans);
  ExpectSame(pause.scans, scans);
  ExpectNothingDone(pause.report);
  // One that jumps ahead by three seconds while the other does not has.
  const Result step = Sequence(Rig(3 * kSecond, 20));
  EXPECT_EQ(step.report.clock_steps, 1);
  EXPECT_EQ(step.scans.size(), 80u);
  for (const LidarScan& scan : step.scans) {
    EXPECT_EQ(scan.stamp_ns, kStart + NumberOf(scan) * kPeriod + 37 * kMs * scan.lidar_id);
  }
}

TEST(ScanSequencer, TakesStraysOutOfAScan) {
  for (const std::int64_t wrong :
       {1500 * kMs, -1500 * kMs, 5 * kDay, -kStart, std::numeric_limits<std::int64_t>::max() / 2}) {
    std::vector<LidarScan> scans = WithStamps(Regular(30));
    for (const std::size_t i : {0, 1, 15}) scans[i].points[4].t_ns += wrong;
    const Result result = Sequence(scans);
    ASSERT_EQ(result.scans.size(), 30u) << wrong;
    EXPECT_EQ(result.LargestError(), 0);
    EXPECT_EQ(result.report.points, 3);
    EXPECT_EQ(result.scans[15].points.size(), 9u);
    EXPECT_EQ(result.report.Dropped(), 0);
  }
}

TEST(ScanSequencer, AScanInSeveralMessagesWithOneStampIsJudgedByItsPoints) {
  std::vector<LidarScan> parts;
  for (int i = 0; i < 20; ++i) {
    const LidarScan whole = MakeScan(i, kStart + i * kPeriod);
    for (const std::size_t first : {0, 5}) {
      LidarScan part = whole;
      part.points.assign(whole.points.begin() + static_cast<std::ptrdiff_t>(first),
                         whole.points.begin() + static_cast<std::ptrdiff_t>(first + 5));
      parts.push_back(part);
    }
  }
  const Result result = Sequence(parts);
  ExpectSame(result.scans, parts);
  ExpectNothingDone(result.report);
}

TEST(ScanSequencer, ScansWithoutPointsAreNoMatter) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  for (const std::size_t i : {0, 1, 2, 3, 4, 12}) {
    scans[i].points.clear();
    scans[i].stamp_ns += kDay;
  }
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 24u);
  EXPECT_EQ(result.LargestError(), 0);
  ExpectNothingDone(result.report);
}

TEST(ScanSequencer, CountsTheScansAfterTheLastOneOfUse) {
  // The last scan with points comes after a lost one: it is held, and handed on when all have come.
  std::vector<LidarScan> scans = WithStamps(Regular(40));
  scans[19] = MakeScan(19, scans[19].stamp_ns + 100 * kMs);
  for (std::size_t i = 20; i < scans.size(); ++i) scans[i].points.clear();
  std::size_t handed_on = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) {
    ++handed_on;
    sequencer.NoteUse();
  });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  EXPECT_EQ(handed_on, 19U);
  sequencer.Finish();
  EXPECT_EQ(handed_on, 20U);
  EXPECT_EQ(sequencer.report().Unseen(), 20);
}

TEST(ScanSequencer, CountsTheScansBeforeTheFirstOneOfUse) {
  int handed_on = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) {
    if (++handed_on == 8 || handed_on == 12) sequencer.NoteUse();
  });
  for (const LidarScan& scan : WithStamps(Regular(20))) sequencer.Add(scan);
  sequencer.Finish();
  EXPECT_EQ(sequencer.report().before_first_point, 7);
  EXPECT_EQ(sequencer.report().Unseen(), 8);
}

TEST(ScanSequencer, AnyStampsGiveIncreasingTimesAndEveryScanIsAccountedFor) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::int64_t n) {
      return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
    };
    const int lidars = 1 + static_cast<int>(below(3));
    std::vector<std::int64_t> now(3, kStart);
    std::size_t out = 0;
    std::vector<std::int64_t> newest(3, std::numeric_limits<std::int64_t>::min());
    Segmenter segmenter({});
    std::size_t segments = 0;
    ScanSequencer sequencer(0.5, [&](const LidarScan& scan) {
      ++out;
      segmenter.AddScan(scan);
      while (segmenter.Next()) ++segments;
      std::int64_t begin = scan.stamp_ns;
      if (scan.has_point_times) {
        begin = scan.points[0].t_ns;
        for (const LidarPoint& point : scan.points) begin = std::min(begin, point.t_ns);
      }
      EXPECT_GT(begin, newest[static_cast<std::size_t>(scan.lidar_id)]);
      newest[static_cast<std::size_t>(scan.lidar_id)] = begin;
    });
    const std::int64_t wildness = 1 + below(10);
    for (int i = 0; i < 200; ++i) {
      const auto lidar = static_cast<std::size_t>(below(lidars));
      std::int64_t step = kPeriod;
      switch (below(3 * wildness)) {
        case 0:
          step = -below(kDay);
          break;
        case 1:
          step = below(kDay);
          break;
        case 2:
          step = below(20 * kPeriod) - 10 * kPeriod;
          break;
        case 3:
          step = 0;
          break;
        default:
          break;
      }
      now[lidar] += step;
      std::int64_t stamp = now[lidar];
      if (below(20 * wildness) == 0) stamp = static_cast<std::int64_t>(random());
      LidarScan scan = MakeScan(i, 0, static_cast<int>(lidar));
      scan.stamp_ns = stamp;
      for (LidarPoint& point : scan.points) {
        if (__builtin_add_overflow(point.t_ns, stamp, &point.t_ns)) point.t_ns = stamp;
      }
      if (below(10 * wildness) == 0) scan.points[5].t_ns = static_cast<std::int64_t>(random());
      scan.has_point_times = below(30) != 0;
      sequencer.Add(scan);
    }
    sequencer.Finish();
    const TimeReport& report = sequencer.report();
    EXPECT_EQ(report.scans, 200);
    EXPECT_LT(segments, 10'000u) << seed;
    EXPECT_EQ(out + static_cast<std::size_t>(report.Dropped()), 200u) << seed;
    if (testing::Test::HasFailure()) FAIL() << "seed " << seed;
  }
}

TEST(ScanSequencer, HoldsAFewScansAtMost) {
  // The first LiDAR leaves a doubt behind when it falls silent: the others do not wait for ever.
  std::size_t out = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) { ++out; });
  std::size_t in = 0, most_held = 0;
  for (int i = 0; i < 500; ++i) {
    if (i < 20 || i == 21) {
      sequencer.Add(MakeScan(i, kStart + i * kPeriod, 0));
      ++in;
    }
    sequencer.Add(MakeScan(i, kStart + i * kPeriod + 37 * kMs, 1));
    ++in;
    most_held = std::max(most_held, in - out);
  }
  EXPECT_LE(most_held, 33u);
  sequencer.Finish();
  EXPECT_EQ(out, in);
}

}  // namespace
}  // namespace trajlo
