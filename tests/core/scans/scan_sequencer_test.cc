// SPDX-License-Identifier: MIT
// ScanSequencer in general: order, bounds, points, counts.
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>

#include "core/odometry/segments/segmenter.h"
#include "tests/core/scans/sequence_scans.h"

namespace trajlo::testing {
namespace {

using ::testing::SizeIs;

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
    const Sequenced result = Sequence(scans);
    ExpectSame(result.scans, scans);
    ExpectNothingDone(result.report);
    if (::testing::Test::HasFailure()) FAIL() << "seed " << seed;
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

TEST(ScanSequencer, PutsScansInOrder) {
  for (const int from : {0, 1, 7}) {
    std::vector<LidarScan> scans = WithStamps(Regular(41));
    for (std::size_t i = static_cast<std::size_t>(from); i + 1 < scans.size(); i += 2) {
      std::swap(scans[i], scans[i + 1]);
    }
    const Sequenced result = Sequence(scans);
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
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 30u);
  EXPECT_EQ(result.Numbers()[15], 15);
  EXPECT_EQ(result.report.reordered, 2);
}

TEST(ScanSequencer, AScanThatIsTooLateIsDropped) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  std::rotate(scans.begin() + 10, scans.begin() + 11, scans.begin() + 18);
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.scans.size(), 29u);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_EQ(result.report.Dropped(), 1);
}

TEST(ScanSequencer, ScansOfADriverThatHangsAreDropped) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(MakeScan(i, kStart + i * kPeriod));
  for (int i = 9; i < 14; ++i)
    scans[static_cast<std::size_t>(i)] = MakeScan(8, kStart + i * kPeriod);
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.report.stuck, 5);
  EXPECT_EQ(result.report.points, 50);
  EXPECT_EQ(result.LargestError(), 0);
  EXPECT_THAT(result.scans, SizeIs(15));
}

TEST(ScanSequencer, ASensorWithoutNoiseMayRestAtTheStart) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) scans.push_back(MakeScan(std::max(i - 9, 0), kStart + i * kPeriod));
  const Sequenced result = Sequence(scans);
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

TEST(ScanSequencer, ScansOfWhichEverySecondPointIsMissingAreNotStuck) {
  std::vector<LidarScan> scans;
  for (int i = 0; i < 20; ++i) {
    LidarScan scan = MakeScan(i, kStart + i * kPeriod);
    const std::vector<LidarPoint> points = scan.points;
    // Enough that a fingerprint is made of some of them.
    for (int copy = 0; copy < 1600; ++copy) {
      scan.points.insert(scan.points.end(), points.begin(), points.end());
    }
    for (std::size_t k = 0; k < scan.points.size(); k += 2) {
      scan.points[k].xyz_m.setConstant(std::numeric_limits<float>::quiet_NaN());
    }
    scans.push_back(scan);
  }
  const Sequenced result = Sequence(scans);
  EXPECT_EQ(result.report.stuck, 0);
  EXPECT_THAT(result.scans, SizeIs(20));
}

TEST(ScanSequencer, AScanWhoseReceiverThrowsIsNotHandedOnAgain) {
  std::vector<LidarScan> received;
  bool throws = false;
  ScanSequencer sequencer(0.5, [&](const LidarScan& scan) {
    received.push_back(scan);
    if (std::exchange(throws, false)) throw std::runtime_error("full");
  });
  std::vector<std::int64_t> stamps = Regular(40);
  for (std::size_t i = 20; i < 40; ++i) stamps[i] += kHour;  // Moved back to go on.
  int thrown = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    throws = i == 30;
    try {
      sequencer.Add(MakeScan(static_cast<int>(i), stamps[i]));
    } catch (const std::runtime_error&) {
      ++thrown;
    }
  }
  sequencer.Finish();
  EXPECT_EQ(thrown, 1);
  ASSERT_THAT(received, SizeIs(40));
  for (int i = 0; i < 40; ++i) {
    const LidarScan& scan = received[static_cast<std::size_t>(i)];
    EXPECT_EQ(NumberOf(scan), i);
    EXPECT_EQ(scan.stamp_ns, kStart + i * kPeriod);
  }
}

TEST(ScanSequencer, TakesStraysOutOfAScan) {
  for (const std::int64_t wrong :
       {1500 * kMs, -1500 * kMs, 5 * kDay, -kStart, std::numeric_limits<std::int64_t>::max() / 2}) {
    std::vector<LidarScan> scans = WithStamps(Regular(30));
    for (const std::size_t i : {0, 1, 15}) scans[i].points[4].t_ns += wrong;
    const Sequenced result = Sequence(scans);
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
  const Sequenced result = Sequence(parts);
  ExpectSame(result.scans, parts);
  ExpectNothingDone(result.report);
}

TEST(ScanSequencer, ScansWithoutPointsAreNoMatter) {
  std::vector<LidarScan> scans = WithStamps(Regular(30));
  for (const std::size_t i : {0, 1, 2, 3, 4, 12}) {
    scans[i].points.clear();
    scans[i].stamp_ns += kDay;
  }
  const Sequenced result = Sequence(scans);
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

TEST(ScanSequencer, ALoneScanBehindALongPauseLeavesTheEndInDoubt) {
  for (const std::size_t odd : {19U, 12U}) {
    std::vector<std::int64_t> stamps = Regular(20);
    stamps[odd] += 2400 * kMs;
    ScanSequencer sequencer(0.5, [](const LidarScan&) {});
    for (const LidarScan& scan : WithStamps(stamps)) sequencer.Add(scan);
    sequencer.Finish();
    EXPECT_NEAR(sequencer.report().doubtful_end_s, odd == 19 ? 2.5 : 0.0, 1e-9);
  }
}

TEST(ScanSequencer, ALoneScanBeforeALongPauseLeavesTheBeginInDoubt) {
  const auto doubtful_begin_s = [](std::size_t odd, std::int64_t shift_ns) {
    std::vector<std::int64_t> stamps = Regular(20);
    stamps[odd] -= shift_ns;
    ScanSequencer sequencer(0.5, [](const LidarScan&) {});
    for (const LidarScan& scan : WithStamps(stamps)) sequencer.Add(scan);
    sequencer.Finish();
    return sequencer.report().doubtful_begin_s;
  };
  EXPECT_NEAR(doubtful_begin_s(0, 2100 * kMs), 2.2, 1e-9);
  EXPECT_EQ(doubtful_begin_s(7, 2100 * kMs), 0.0);
  // No pause is so long: the stamp is wrong.
  EXPECT_EQ(doubtful_begin_s(0, 3'600'000 * kMs), 0.0);
}

TEST(ScanSequencer, CountsTheScansBeforeTheFirstPose) {
  // The first two have no points. The pose is found when more scans have come, and lies in a sweep.
  std::vector<LidarScan> scans = WithStamps(Regular(20));
  for (std::size_t i = 0; i < 2; ++i) scans[i].points.clear();
  for (const std::int64_t late : {0, 70}) {
    int handed_on = 0;
    ScanSequencer sequencer(0.5, [&](const LidarScan&) {
      if (++handed_on == 10) sequencer.NoteFirstPose(scans[7].stamp_ns + late * kMs);
    });
    for (const LidarScan& scan : scans) sequencer.Add(scan);
    sequencer.Finish();
    EXPECT_EQ(sequencer.report().before_first_pose, 7);
  }
}

TEST(ScanSequencer, NoScanIsBeforeAFirstPoseAtItsFirstPointWhereStampsMarkTheEnd) {
  std::vector<LidarScan> scans = WithStamps(Regular(20));
  const std::int64_t first_point_ns = scans[0].stamp_ns;
  for (LidarScan& scan : scans) scan.stamp_ns += kPeriod;
  int handed_on = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) {
    if (++handed_on == 5) sequencer.NoteFirstPose(first_point_ns);
  });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  sequencer.Finish();
  EXPECT_EQ(sequencer.report().before_first_pose, 0);
}

TEST(ScanSequencer, ThePoseOfTheFirstScansOfTwoLidarsHasNoneBefore) {
  std::vector<LidarScan> scans;
  for (const LidarScan& scan : WithStamps(Regular(20))) {
    scans.push_back(scan);
    scans.push_back(scan);
    scans.back().lidar_id = 1;
  }
  int handed_on = 0;
  ScanSequencer sequencer(0.5, [&](const LidarScan&) {
    if (++handed_on == 12) sequencer.NoteFirstPose(scans[0].stamp_ns);
  });
  for (const LidarScan& scan : scans) sequencer.Add(scan);
  sequencer.Finish();
  EXPECT_EQ(sequencer.report().before_first_pose, 0);
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
    if (::testing::Test::HasFailure()) FAIL() << "seed " << seed;
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
}  // namespace trajlo::testing
