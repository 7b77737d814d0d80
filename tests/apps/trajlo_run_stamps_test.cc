// SPDX-License-Identifier: MIT
// What the command makes of recordings whose stamps or point times are wrong: the right trajectory
// and a word about it, or an exit code that says that there is none.
#include <csignal>
#include <functional>

#include "tests/apps/trajlo_run_testing.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1'000 * kMs;
constexpr std::int64_t kHour = 3600 * kSecond;
constexpr std::int64_t kDay = 24 * kHour;
constexpr int kScans = 24;

/// Seconds in nanoseconds, as text.
std::string Text(std::int64_t t_ns) {
  char text[40];
  const auto size_ns = static_cast<long long>(std::abs(t_ns));
  std::snprintf(text, sizeof(text), "%s%lld.%09lld", t_ns < 0 ? "-" : "", size_ns / kSecond,
                size_ns % kSecond);
  return text;
}

std::vector<std::int64_t> Regular() {
  std::vector<std::int64_t> stamps;
  for (int i = 0; i < kScans; ++i) stamps.push_back(1000 * kSecond + i * 100 * kMs);
  return stamps;
}

class StampsTest : public TrajloRunTest {
 protected:
  StampsTest() {
    room_.scans = kScans;
    room_.rest_s = 0.0;  // At rest, scans without noise are the same scan again and again.
  }

  static void WriteTimes(const fs::path& file, const std::vector<std::int64_t>& times_ns) {
    std::ofstream stream(file);
    for (const std::int64_t t_ns : times_ns) stream << Text(t_ns) << "\n";
  }

  /// The recording with other stamps.
  void Write(const std::vector<std::int64_t>& stamps) const {
    fs::remove_all(input());
    room_.Write(input());
    WriteTimes(temp_ / "in/timestamps.txt", stamps);
  }

  void WriteEdited(const std::function<void(std::vector<std::int64_t>*)>& edit) const {
    std::vector<std::int64_t> stamps = Regular();
    edit(&stamps);
    Write(stamps);
  }

  /// No file of a result may become larger than 20 MB.
  Outcome RunAnew(std::vector<std::string> more = {}) const {
    fs::remove_all(output());
    more.insert(more.begin(), {"--input=" + input(), "--output=" + output()});
    return Call(more, 20'000'000);
  }

  /// The largest error of the poses, and how long they go on.
  void ExpectRight(double within_m = 0.02) const {
    const std::vector<StampedPose> poses = Trajectory();
    ASSERT_FALSE(poses.empty());
    double begin_s = 1e-9 * static_cast<double>(poses.front().t_ns) - RoomRecording::kStart;
    for (const StampedPose& pose : poses) {
      const double t_s = 1e-9 * static_cast<double>(pose.t_ns) - RoomRecording::kStart;
      const double x_m = room_.PositionX(t_s) - room_.PositionX(begin_s);
      EXPECT_LT((pose.T_world_body.t - Eigen::Vector3d(x_m, 0, 0)).norm(), within_m) << t_s;
    }
    EXPECT_LT(begin_s, 0.21);
    EXPECT_NEAR(1e-9 * static_cast<double>(poses.back().t_ns) - RoomRecording::kStart, 2.4, 0.05);
  }

  std::int64_t Count(const char* what) const { return RunJson()["input"]["scans"][what]; }

  RoomRecording room_;
};

TEST_F(StampsTest, OneWrongStampCostsOneScanAtMost) {
  for (const std::int64_t wrong : {5 * kDay, -5 * kDay, 2 * kSecond, -1000 * kSecond}) {
    for (const std::size_t at : {0, 12}) {
      WriteEdited([&](auto* stamps) { (*stamps)[at] += wrong; });
      const Outcome outcome = RunAnew();
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_THAT(outcome.err,
                  HasSubstr(at == 0 ? "of 24 scans: 1 dropped" : "of 24 scans: 1 given"));
      EXPECT_EQ(Count("stamp_fits_nowhere"), at == 0 ? 1 : 0);
      EXPECT_EQ(Count("retimed"), at == 0 ? 0 : 1);
      ExpectRight();
    }
  }
}

TEST_F(StampsTest, AClockThatStepsIsFollowed) {
  for (const std::int64_t step : {-kHour, kHour, -kSecond}) {
    WriteEdited([&](auto* stamps) {
      for (std::size_t i = 10; i < stamps->size(); ++i) (*stamps)[i] += step;
    });
    const Outcome outcome = RunAnew();
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("14 of 24 scans are not those of their stamps"));
    EXPECT_THAT(outcome.err, HasSubstr(step > 0 ? "lidar 0: its clock steps ahead by 3600.000 s"
                                                : "lidar 0: its clock steps back by "));
    EXPECT_EQ(RunJson()["input"]["clock_steps"], 1);
    ExpectRight();
  }
}

TEST_F(StampsTest, SwappedScansArePutInOrder) {
  std::vector<std::int64_t> stamps = Regular();
  Write(stamps);
  for (int i = 0; i + 1 < kScans; i += 2) {
    std::swap(stamps[static_cast<std::size_t>(i)], stamps[static_cast<std::size_t>(i) + 1]);
    fs::rename(RoomRecording::File(input(), i), temp_ / "in/one");
    fs::rename(RoomRecording::File(input(), i + 1), RoomRecording::File(input(), i));
    fs::rename(temp_ / "in/one", RoomRecording::File(input(), i + 1));
  }
  WriteTimes(temp_ / "in/timestamps.txt", stamps);
  EXPECT_EQ(RunAnew().exit_code, 0);
  EXPECT_EQ(Count("reordered"), kScans / 2);
  ExpectRight();
}

TEST_F(StampsTest, StampsThatAllRepeatOrAllGoBackAreThree) {
  Write(std::vector<std::int64_t>(kScans, 1000 * kSecond));
  const Outcome equal = RunAnew();
  EXPECT_EQ(equal.exit_code, 3) << equal.err;
  EXPECT_THAT(equal.err, HasSubstr("the times of 23 of 24 scans are not those of their stamps"));
  ExpectRight(0.1);
  WriteEdited([](auto* stamps) { std::reverse(stamps->begin(), stamps->end()); });
  const Outcome reversed = RunAnew();
  EXPECT_EQ(reversed.exit_code, 3) << reversed.err;
  EXPECT_THAT(reversed.err, HasSubstr("% of the points were dropped because of their times"));
}

TEST_F(StampsTest, RepeatedStampsGetTheirOwnTimes) {
  WriteEdited([](auto* stamps) { (*stamps)[12] = (*stamps)[11]; });
  EXPECT_EQ(RunAnew().exit_code, 0);
  EXPECT_EQ(Count("retimed"), 1);
  ExpectRight();
}

TEST_F(StampsTest, LeadingScansWithoutUsablePointsDoNotSwitchThePointTimesOff) {
  const float nan = std::nanf("");
  using Damage = std::function<void(std::vector<Eigen::Vector4f>*)>;
  const std::vector<Damage> damages = {
      [](auto* points) { points->clear(); },
      [](auto* points) { points->resize(1); },
      [&](auto* points) {
        for (Eigen::Vector4f& p : *points) p.head<3>().setConstant(nan);
      },
      [](auto* points) {
        for (Eigen::Vector4f& p : *points) p.head<3>().setZero();
      },
  };
  for (const Damage& damage : damages) {
    Write(Regular());
    for (int i = 0; i < 5; ++i) {
      std::vector<Eigen::Vector4f> points = room_.Scan(i);
      damage(&points);
      RoomRecording::WriteScan(RoomRecording::File(input(), i), points);
    }
    const Outcome outcome = RunAnew();
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("field 'time'"));
    EXPECT_NEAR(Count("unseen_at_the_start"), 5, 2);
    const std::vector<StampedPose> poses = Trajectory();
    ASSERT_GT(poses.size(), 50u) << "a pose every 30 ms";
    // No pose where nothing was seen, give or take the sweep that begins the map.
    EXPECT_NEAR(1e-9 * static_cast<double>(poses[0].t_ns - Regular()[5]), 0.0, 0.21);
  }
}

TEST_F(StampsTest, OneBadPointTimeInTheFirstScansCostsOnePoint) {
  for (const float wrong : {1e12F, -77.0F, 3.4e38F, 1.5F}) {
    for (const int scan : {0, 1, 12}) {
      Write(Regular());
      std::vector<Eigen::Vector4f> points = room_.Scan(scan);
      points[100][3] = wrong;
      RoomRecording::WriteScan(RoomRecording::File(input(), scan), points);
      const Outcome outcome = RunAnew();
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto json = RunJson()["input"]["points"];
      EXPECT_EQ(json["without_time"].get<int>() + json["wrong_time"].get<int>(), 1) << wrong;
      EXPECT_EQ(json["too_late"], 0);
      ExpectRight();
    }
  }
}

class TwoLidarsTest : public StampsTest {
 protected:
  /// Two LiDARs at one place, the times of the second `ahead`; with times of recording or without.
  Outcome RunApart(std::int64_t ahead, bool with_record_times) const {
    fs::remove_all(temp_ / "in");
    std::vector<std::int64_t> stamps = Regular();
    for (const char* lidar : {"in/lidar0", "in/lidar1"}) {
      room_.Write(temp_ / lidar);
      std::vector<std::int64_t> recorded = Regular();
      for (std::int64_t& t_ns : recorded) t_ns += 101 * kMs;
      if (with_record_times) WriteTimes(temp_ / lidar / "record_times.txt", recorded);
    }
    for (std::int64_t& t_ns : stamps) t_ns += ahead;
    WriteTimes(temp_ / "in/lidar1/timestamps.txt", stamps);
    return RunAnew({"--set=sensor.T_body_lidar=[{}, {}]"});
  }
};

TEST_F(TwoLidarsTest, ThatMeetAreBothUsed) {
  const Outcome outcome = RunApart(0, true);
  EXPECT_EQ(outcome.exit_code, 0);
  // At rest, it is seen from a single place.
  EXPECT_THAT(outcome.err, HasSubstr("from enough places"));
  ExpectRight();
}

TEST_F(TwoLidarsTest, WhoseClocksDoNotMeetAreNotMixed) {
  for (const std::int64_t ahead : {kDay, -kDay, 3 * kSecond, -3 * kSecond}) {
    const Outcome outcome = RunApart(ahead, true);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr("lidar 1: its times are"),
                                   HasSubstr("input.clock_offset_s"), HasSubstr("50 % of the")));
    EXPECT_EQ(Count("clock_apart"), kScans);
    ExpectRight();
  }
}

TEST_F(TwoLidarsTest, ThatAreMergedByStampsOfClocksThatDifferAreNotTakenForRight) {
  for (const std::int64_t ahead : {kDay, 3 * kSecond}) {
    const Outcome outcome = RunApart(ahead, false);
    EXPECT_TRUE(outcome.exit_code == 3 || outcome.exit_code == 4) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("input.clock_offset_s"));
  }
}

TEST_F(StampsTest, AStampOfZeroDoesNotFillTheDisk) {
  WriteEdited([](auto* stamps) {
    for (std::int64_t& t_ns : *stamps) t_ns += 1'700'000'000 * kSecond;
    (*stamps)[0] = 0;
  });
  const Outcome outcome = RunAnew({"--rate=100"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(Trajectory().size(), 250u);
  EXPECT_GT(Trajectory().size(), 200u);
}

TEST_F(StampsTest, AtARateAPauseIsLeftOut) {
  WriteEdited([](auto* stamps) {
    for (std::size_t i = 12; i < stamps->size(); ++i) (*stamps)[i] += 40 * kSecond;
  });
  RunAnew({"--rate=100"});
  EXPECT_LT(Trajectory().size(), 250u);
}

TEST_F(StampsTest, ACutFileIsNamedAsSuch) {
  Write(Regular());
  std::ofstream(temp_ / "in/scans/000012.pcd", std::ios::app).flush();
  fs::resize_file(temp_ / "in/scans/000012.pcd",
                  fs::file_size(temp_ / "in/scans/000012.pcd") - 100);
  const Outcome outcome = RunAnew();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("1 scan is damaged"), Not(HasSubstr("could not be read"))));
}

}  // namespace
}  // namespace trajlo::testing
