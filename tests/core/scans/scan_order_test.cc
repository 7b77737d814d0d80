// SPDX-License-Identifier: MIT
// ScanSequencer on scans of a LiDAR that moves: what they show tells more than their stamps.
#include <gtest/gtest.h>

#include "core/scans/scan_sequencer.h"
#include "core/scans/scan_times.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

constexpr std::int64_t kPeriod = 100'000'000;

struct Result {
  std::vector<LidarScan> scans;
  TimeReport report;
};

Result Sequence(const std::vector<LidarScan>& scans) {
  Result result;
  ScanSequencer sequencer(0.5, [&](const LidarScan& scan) { result.scans.push_back(scan); });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  sequencer.Finish();
  result.report = sequencer.report();
  return result;
}

/// In a room, from rest or at 3 m/s; sweeps with point times, or motion-corrected ones.
class Moving : public ::testing::TestWithParam<bool> {
 protected:
  std::vector<LidarScan> Scans(int count, double speed_m_s = 3.0) const {
    testing::SyntheticWorld world;
    world.beams = 16;
    world.columns = 240;
    world.T_world_body = [&](double t) {
      return SE3(Eigen::Quaterniond::Identity(), {speed_m_s * t - 4.0, 0.0, 0.0});
    };
    std::vector<LidarScan> scans;
    for (int i = 0; i < count; ++i) {
      scans.push_back(world.Sweep(i));
      scans.back().has_point_times = GetParam();
      for (LidarPoint& point : scans.back().points) {
        point.intensity = static_cast<float>(i);  // its number
        if (!GetParam()) point.t_ns = scans.back().stamp_ns;
      }
    }
    return scans;
  }

  static int NumberOf(const LidarScan& scan) { return static_cast<int>(scan.points[0].intensity); }

  /// All scans come in their true order, at the steady pace at which they were measured.
  static void ExpectTrueTimes(const Result& result, std::size_t count, int without_from = -1,
                              int without_until = -1) {
    ASSERT_EQ(result.scans.size(), count);
    for (const LidarScan& scan : result.scans) {
      const int number = NumberOf(scan);
      EXPECT_TRUE(number < without_from || number >= without_until);
      const std::int64_t since_first_ns = scan.stamp_ns - result.scans[0].stamp_ns;
      EXPECT_EQ(since_first_ns, (number - NumberOf(result.scans[0])) * kPeriod) << number;
    }
  }
};

void SwapTimes(LidarScan* a, LidarScan* b) {
  const std::int64_t to_b_ns = b->stamp_ns - a->stamp_ns;
  ShiftTimes(to_b_ns, a);
  ShiftTimes(-to_b_ns, b);
}

TEST_P(Moving, SwappedStampsDoNotChangeTheOrder) {
  std::vector<LidarScan> scans = Scans(20);
  for (const std::size_t i : {5u, 9u, 14u}) SwapTimes(&scans[i], &scans[i + 1]);
  const Result result = Sequence(scans);
  ExpectTrueTimes(result, scans.size());
  EXPECT_EQ(result.report.retimed, 6);
  EXPECT_EQ(result.report.reordered, 0);
}

TEST_P(Moving, SwappedScansArePutInOrder) {
  std::vector<LidarScan> scans = Scans(20);
  for (const std::size_t i : {5u, 9u, 14u}) std::swap(scans[i], scans[i + 1]);
  const Result result = Sequence(scans);
  ExpectTrueTimes(result, scans.size());
  EXPECT_EQ(result.report.retimed, 0);
  EXPECT_EQ(result.report.reordered, 3);
  EXPECT_EQ(result.report.exchanged, 0);
}

/// Files with wrong names: the stamps go on.
TEST_P(Moving, ScansWithEachOthersPointsAreCountedIfNothingElseTellsTheirTime) {
  std::vector<LidarScan> scans = Scans(20);
  for (const std::size_t i : {5u, 9u, 14u}) {
    SwapTimes(&scans[i], &scans[i + 1]);
    std::swap(scans[i], scans[i + 1]);
  }
  EXPECT_EQ(Sequence(scans).report.exchanged, GetParam() ? 0 : 6);
  EXPECT_EQ(Sequence(Scans(20)).report.exchanged, 0);
  EXPECT_EQ(Sequence(Scans(20, 0.0)).report.exchanged, 0);
}

/// Half of the points are anywhere, so that views cannot tell the order.
TEST_P(Moving, SwappedStampsAmongClutterAreCountedIfNothingElseTellsTheirTime) {
  std::vector<LidarScan> scans = Scans(30);
  testing::Random random(1);
  for (LidarScan& scan : scans) {
    for (std::size_t i = 0; i < scan.points.size(); i += 2) {
      scan.points[i].xyz_m = random.Vector(1.0, 30.0).cast<float>();
    }
  }
  EXPECT_EQ(Sequence(scans).report.exchanged, 0);
  for (const std::size_t i : {5u, 12u, 20u}) SwapTimes(&scans[i], &scans[i + 1]);
  const Result result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), scans.size());
  // With point times, scans are what their points say.
  const std::int64_t mended = result.report.retimed;
  EXPECT_EQ(result.report.exchanged, GetParam() ? 0 : 6 - mended);
}

TEST_P(Moving, AShortStepOfTheClockIsNoPause) {
  for (const std::int64_t step_ns : {3 * kPeriod, 5 * kPeriod + kPeriod / 2, 30 * kPeriod}) {
    std::vector<LidarScan> scans = Scans(25);
    for (std::size_t i = 12; i < scans.size(); ++i) ShiftTimes(step_ns, &scans[i]);
    const Result result = Sequence(scans);
    ExpectTrueTimes(result, scans.size());
    EXPECT_EQ(result.report.clock_steps, 1) << step_ns;
  }
}

TEST_P(Moving, APauseIsNoStepOfTheClock) {
  for (const std::ptrdiff_t lost : {1, 3, 5, 9}) {
    std::vector<LidarScan> scans = Scans(30);
    scans.erase(scans.begin() + 12, scans.begin() + 12 + lost);
    const Result result = Sequence(scans);
    ExpectTrueTimes(result, scans.size(), 12, 12 + static_cast<int>(lost));
    EXPECT_EQ(result.report.clock_steps, 0) << lost;
  }
}

TEST_P(Moving, AtRestAPauseIsBelieved) {
  std::vector<LidarScan> scans = Scans(30, 0.0);
  scans.erase(scans.begin() + 12, scans.begin() + 17);
  const Result result = Sequence(scans);
  ExpectTrueTimes(result, scans.size(), 12, 17);
  EXPECT_EQ(result.report.clock_steps, 0);
}

TEST_P(Moving, AClockThatReturnsIsNoLostScan) {
  std::vector<LidarScan> scans = Scans(30);
  for (std::size_t i = 10; i < 20; ++i) ShiftTimes(-kPeriod, &scans[i]);
  const Result result = Sequence(scans);
  for (const LidarScan& scan : result.scans) {
    const int number = NumberOf(scan);
    if (number < 10 || number >= 20) {
      EXPECT_EQ(scan.stamp_ns - result.scans[0].stamp_ns, number * kPeriod);
    }
  }
  EXPECT_EQ(result.report.clock_steps, 2);
}

TEST_P(Moving, AStartWithSeveralWrongStampsDoesNotSetTheClock) {
  std::vector<LidarScan> scans = Scans(30);
  ShiftTimes(5 * kPeriod, &scans[1]);
  ShiftTimes(7 * kPeriod / 2, &scans[3]);
  ShiftTimes(300 * kPeriod, &scans[5]);
  const Result result = Sequence(scans);
  EXPECT_GE(result.scans.size(), scans.size() - 3);
  for (const LidarScan& scan : result.scans) {
    EXPECT_EQ(scan.stamp_ns - result.scans[0].stamp_ns, NumberOf(scan) * kPeriod);
  }
  EXPECT_EQ(result.report.clock_steps, 0);
}

std::string NameOf(const ::testing::TestParamInfo<bool>& info) {
  return info.param ? "WithPointTimes" : "MotionCorrected";
}

INSTANTIATE_TEST_SUITE_P(Sweeps, Moving, ::testing::Bool(), NameOf);

}  // namespace
}  // namespace trajlo
