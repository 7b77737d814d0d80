// SPDX-License-Identifier: MIT
#include "core/io/recording/cloud_recording.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/recording/chained_clouds.h"
#include "core/io/recording/excerpt.h"
#include "tests/core/io/recording/fake_clouds.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using trajlo::testing::FakeClouds;
using trajlo::testing::FakeMessage;
using trajlo::testing::kMs;
using trajlo::testing::RegularMessages;

constexpr std::int64_t kStart = 1'000'000 * kMs;

std::unique_ptr<CloudRecording> Open(const FakeClouds& fake, const RecordingOptions& options = {},
                                     std::size_t first_lidar_id = 0) {
  return std::make_unique<CloudRecording>(
      "fake.bag", [fake] { return std::make_unique<FakeClouds>(fake); }, options, first_lidar_id);
}

std::string ErrorOf(const FakeClouds& fake, const RecordingOptions& options = {}) {
  try {
    Open(fake, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::vector<LidarScan> ReadAll(ScanSource* source) {
  std::vector<LidarScan> scans;
  for (LidarScan scan; source->Next(&scan);) scans.push_back(scan);
  return scans;
}

TEST(CloudRecording, TakesTheOnlyTopicWithCloudsAndIgnoresOthers) {
  auto messages = RegularMessages(6, 100 * kMs);
  messages.push_back({1, kStart, kStart});
  const auto recording = Open(FakeClouds({"/cloud", "/imu"}, messages));
  EXPECT_EQ(recording->size(), 6u);
  EXPECT_THAT(recording->description(), HasSubstr("lidar 0 is /cloud"));
  EXPECT_EQ(ReadAll(recording.get()).size(), 6u);
  EXPECT_THAT(recording->report().topics_without_messages, IsEmpty());
  EXPECT_EQ(recording->report().points_read, 60u);
  EXPECT_FALSE(recording->report().IsPartial());
}

TEST(CloudRecording, SeveralCloudsWithoutAChoiceAreAnErrorThatNamesThem) {
  auto messages = RegularMessages(6, 100 * kMs);
  messages.push_back({1, kStart, kStart});
  const FakeClouds fake({"/cloud_a", "/cloud_b"}, messages);
  EXPECT_THAT(ErrorOf(fake), HasSubstr("/cloud_b (sensor_msgs/PointCloud2, 1 message)"));
  RecordingOptions options;
  options.topics = {"/cloud_c"};
  EXPECT_THAT(ErrorOf(fake, options), HasSubstr("no topic '/cloud_c'"));
}

TEST(CloudRecording, ATopicWithoutAMessageIsToldToBeUnused) {
  RecordingOptions options;
  options.topics = {"/cloud_a", "/cloud_b"};
  const auto recording =
      Open(FakeClouds({"/cloud_a", "/cloud_b"}, RegularMessages(6, 2 * kMs)), options);
  EXPECT_THAT(recording->description(),
              AllOf(HasSubstr("lidar 1 is /cloud_b"), HasSubstr("0 messages: it is not used")));
  EXPECT_EQ(ReadAll(recording.get()).size(), 6u);
  EXPECT_THAT(recording->report().warnings,
              ElementsAre(HasSubstr("topic /cloud_b has no message: LiDAR 1 is not used")));
  EXPECT_THAT(recording->report().topics_without_messages, ElementsAre("/cloud_b"));
  EXPECT_TRUE(recording->report().IsPartial());
}

TEST(CloudRecording, CloudsThatAreRegisteredAlreadyAreTold) {
  const auto warnings_in = [](const std::string& frame_id) {
    auto messages = RegularMessages(6, 2 * kMs);
    for (FakeMessage& message : messages) message.frame_id = frame_id;
    return Open(FakeClouds({"/cloud"}, messages))->report().warnings;
  };
  for (const char* fixed : {"map", "/odom", "robot1/map", "camera_init", "world", "earth"}) {
    EXPECT_THAT(warnings_in(fixed), ElementsAre(HasSubstr("does not move with the LiDAR")))
        << fixed;
  }
  for (const char* moving : {"", "velodyne", "base_link", "map_lidar", "os_sensor"}) {
    EXPECT_THAT(warnings_in(moving), IsEmpty()) << moving;
  }
}

TEST(CloudRecording, StampsOfTheSweepsEndAreSeenByTheTimeOfRecording) {
  const auto at_end = Open(FakeClouds({"/cloud"}, RegularMessages(6, 2 * kMs)));
  EXPECT_EQ(at_end->time_convention(0).stamp_at, StampAt::kEnd);
  EXPECT_EQ(ReadAll(at_end.get())[0].points[9].t_ns, kStart - 10 * kMs);
  const auto at_start = Open(FakeClouds({"/cloud"}, RegularMessages(6, 102 * kMs)));
  EXPECT_EQ(at_start->time_convention(0).stamp_at, StampAt::kStart);
  EXPECT_EQ(ReadAll(at_start.get())[0].points[9].t_ns, kStart + 90 * kMs);
  const auto other_clock = Open(FakeClouds({"/cloud"}, RegularMessages(6, 1'000'000 * kMs)));
  EXPECT_EQ(other_clock->time_convention(0).stamp_at, StampAt::kStart);
  EXPECT_THAT(other_clock->description(), HasSubstr("the clocks differ"));
}

TEST(CloudRecording, ADelayOfZeroIsNoProofAndSaysSo) {
  const auto copied = Open(FakeClouds({"/cloud"}, RegularMessages(6, 0)));
  EXPECT_EQ(copied->time_convention(0).stamp_at, StampAt::kStart);
  ASSERT_EQ(copied->report().warnings.size(), 1u);
  EXPECT_THAT(copied->report().warnings[0],
              AllOf(HasSubstr("fake.bag: /cloud"), HasSubstr("input.stamp_at")));
  RecordingOptions options;
  options.stamp_at.values = {StampAt::kEnd};
  EXPECT_THAT(Open(FakeClouds({"/cloud"}, RegularMessages(6, 0)), options)->report().warnings,
              IsEmpty());
  EXPECT_THAT(Open(FakeClouds({"/cloud"}, RegularMessages(6, 2 * kMs)))->report().warnings,
              IsEmpty());
}

TEST(CloudRecording, LeadingMessagesWithoutPointsDoNotSwitchTheTimesOff) {
  auto messages = RegularMessages(20, 101 * kMs);
  for (std::size_t i = 0; i < 7; ++i) messages[i].is_empty = true;
  const auto recording = Open(FakeClouds({"/cloud"}, messages));
  EXPECT_EQ(recording->time_convention(0).field, "t");
  EXPECT_TRUE(ReadAll(recording.get()).at(10).has_point_times);
}

TEST(CloudRecording, TellsWhenScansWereRecorded) {
  const auto recording = Open(FakeClouds({"/cloud"}, RegularMessages(6, 101 * kMs)));
  EXPECT_EQ(ReadAll(recording.get()).at(2).recorded_ns, kStart + 301 * kMs);
}

TEST(CloudRecording, WhatTheUserSaysAboutStampsWinsOverTheEvidence) {
  RecordingOptions options;
  options.stamp_at.values = {StampAt::kStart};
  const auto recording = Open(FakeClouds({"/cloud"}, RegularMessages(6, 2 * kMs)), options);
  EXPECT_EQ(ReadAll(recording.get())[0].points[0].t_ns, kStart);
}

TEST(CloudRecording, EachLidarHasItsOwnConventionAndClock) {
  std::vector<FakeMessage> messages;
  for (int i = 0; i < 8; ++i) {
    const std::int64_t stamp_ns = kStart + i * 100 * kMs;
    messages.push_back({0, stamp_ns, stamp_ns + kMs});
    messages.push_back({1, stamp_ns + 30 * kMs, stamp_ns + 131 * kMs});
  }
  RecordingOptions options;
  options.topics = {"/cloud_b", "/cloud_a"};
  options.clock_offset_s.values = {9.0, 0.0, 0.005};
  const auto recording = Open(FakeClouds({"/cloud_a", "/cloud_b"}, messages), options, 1);
  const std::vector<LidarScan> scans = ReadAll(recording.get());
  ASSERT_EQ(scans.size(), 16u);
  EXPECT_EQ(scans[0].lidar_id, 2);  // /cloud_a, its stamp marks the end, its clock is late.
  EXPECT_EQ(scans[0].stamp_ns, kStart + 5 * kMs);
  EXPECT_EQ(scans[0].points[0].t_ns, kStart + 5 * kMs - 100 * kMs);
  EXPECT_EQ(scans[1].lidar_id, 1);
  EXPECT_EQ(scans[1].points[0].t_ns, kStart + 30 * kMs);
}

TEST(CloudRecording, TheTimeOfRecordingStandsForStampsThatAreNotFilled) {
  auto messages = RegularMessages(6, 0);
  for (FakeMessage& message : messages) message.stamp_ns = 0;
  const auto recording = Open(FakeClouds({"/cloud"}, messages));
  EXPECT_THAT(recording->description(), HasSubstr("which follow the end of the sweep"));
  EXPECT_THAT(recording->report().warnings, ::testing::ElementsAre(HasSubstr("stamps are zero")));
  const LidarScan scan = ReadAll(recording.get())[5];
  EXPECT_EQ(scan.stamp_ns, kStart + 500 * kMs);
  // A message is recorded when its sweep has ended.
  EXPECT_EQ(scan.points[0].t_ns, kStart + 400 * kMs);
}

TEST(CloudRecording, WhatStampsMarkCanBeToldWhereTheyAreNotFilled) {
  auto messages = RegularMessages(6, 0);
  for (FakeMessage& message : messages) message.stamp_ns = 0;
  RecordingOptions options;
  options.stamp_at.values = {StampAt::kStart};
  const auto recording = Open(FakeClouds({"/cloud"}, messages), options);
  EXPECT_EQ(ReadAll(recording.get())[5].points[0].t_ns, kStart + 500 * kMs);
}

TEST(CloudRecording, ABrokenMessageIsCountedAndACutFileIsReported) {
  auto messages = RegularMessages(6, 100 * kMs);
  messages[2].x = "distance";
  MessageReport at_end;
  at_end.damaged = true;
  at_end.warnings = {"fake.bag: cut at byte 1234"};
  const auto recording = Open(FakeClouds({"/cloud"}, messages, at_end));
  EXPECT_EQ(ReadAll(recording.get()).size(), 5u);
  EXPECT_EQ(recording->report().scans_skipped, 1u);
  EXPECT_TRUE(recording->report().file_is_cut);
  EXPECT_TRUE(recording->report().IsPartial());
  EXPECT_THAT(recording->report().warnings.back(), HasSubstr("byte 1234"));
}

TEST(CloudRecording, WithoutAReadableMessageThereIsAnError) {
  auto messages = RegularMessages(2, 100 * kMs);
  for (FakeMessage& message : messages) message.x = "distance";
  EXPECT_THAT(ErrorOf(FakeClouds({"/cloud"}, messages)),
              ::testing::AllOf(HasSubstr("no message with points"),
                               HasSubstr("needs the fields x, y and z, but there are: distance")));
}

TEST(ChainedClouds, ReadsPartsOneAfterTheOtherAndJoinsTopicsByName) {
  std::vector<std::unique_ptr<CloudMessageReader>> parts;
  MessageReport damaged;
  damaged.damaged = true;
  damaged.bytes_lost = 7;
  parts.push_back(std::make_unique<FakeClouds>(std::vector<std::string>{"/cloud", "/imu"},
                                               RegularMessages(2, 0), damaged));
  auto later = RegularMessages(3, 0);
  for (FakeMessage& message : later) message.topic = 1;
  parts.push_back(
      std::make_unique<FakeClouds>(std::vector<std::string>{"/cloud_new", "/cloud"}, later));
  ChainedClouds chain(std::move(parts));
  ASSERT_EQ(chain.topics().size(), 3u);
  EXPECT_EQ(chain.topics()[0].messages, 5u);
  EXPECT_TRUE(chain.IsCloud(2));
  chain.Select({0});
  CloudMessage message;
  int count = 0;
  for (; chain.Next(&message); ++count) EXPECT_EQ(message.topic, 0u);
  EXPECT_EQ(count, 5);
  EXPECT_TRUE(chain.report().damaged);
  EXPECT_EQ(chain.report().bytes_lost, 7u);
}

TEST(ChainedClouds, ReportsDamageAtOnce) {
  MessageReport damaged;
  damaged.warnings = {"the index is broken"};
  auto first = std::make_unique<FakeClouds>(std::vector<std::string>{"/cloud"},
                                            RegularMessages(3, 0), damaged);
  CloudMessage message;
  while (first->Next(&message)) {
  }
  std::vector<std::unique_ptr<CloudMessageReader>> parts;
  parts.push_back(std::move(first));
  const ChainedClouds chain(std::move(parts));
  EXPECT_THAT(chain.report().warnings, ElementsAre("the index is broken"))
      << "before a message was read";
}

TEST(Excerpt, KeepsTheScansWithinItsTime) {
  Excerpt excerpt(Open(FakeClouds({"/cloud"}, RegularMessages(30, 100 * kMs))), 500 * kMs,
                  300 * kMs);
  std::vector<std::int64_t> stamps_ms;
  for (const LidarScan& scan : ReadAll(&excerpt))
    stamps_ms.push_back((scan.stamp_ns - kStart) / kMs);
  EXPECT_THAT(stamps_ms, ElementsAre(500, 600, 700));
}

TEST(Excerpt, CountsWhatItHandsOnAndNotWhatIsReadAroundIt) {
  Excerpt excerpt(Open(FakeClouds({"/cloud"}, RegularMessages(30, 100 * kMs))), 500 * kMs,
                  300 * kMs);
  EXPECT_EQ(excerpt.report().scans_listed, 30u);
  std::size_t points = 0;
  for (const LidarScan& scan : ReadAll(&excerpt)) points += scan.points.size();
  EXPECT_EQ(excerpt.report().scans_read, 3u);
  EXPECT_EQ(excerpt.report().points_read, points);
}

/// A scan of ten points every 100 ms; those of the first five have no time, and as many follow that
/// are not declared.
class LateClock final : public ScanSource {
 public:
  bool Next(LidarScan* scan) override {
    if (report_.scans_read == size()) return false;
    scan->stamp_ns = kStart + static_cast<std::int64_t>(report_.scans_read) * 100 * kMs;
    scan->points.assign(10, {});
    report_.points_without_time += ++report_.scans_read <= 5 ? 10 : 0;
    report_.points_undeclared = report_.points_without_time;
    return true;
  }
  std::size_t size() const override { return 30; }
  const std::string& description() const override { return description_; }
  const ReadReport& report() const override { return report_; }

 private:
  std::string description_;
  ReadReport report_;
};

TEST(Excerpt, OddPointsOfScansThatItLeavesOutAreNotCounted) {
  Excerpt before(std::make_unique<LateClock>(), 0, 300 * kMs);
  EXPECT_EQ(ReadAll(&before).size(), 3u);
  EXPECT_EQ(before.report().points_without_time, 30u);
  EXPECT_EQ(before.report().points_undeclared, 30u);
  Excerpt after(std::make_unique<LateClock>(), 500 * kMs, 300 * kMs);
  EXPECT_EQ(ReadAll(&after).size(), 3u);
  EXPECT_EQ(after.report().points_without_time, 0u);
  EXPECT_EQ(after.report().points_undeclared, 0u);
}

TEST(Excerpt, IsWhereItIsInSpiteOfWrongStamps) {
  constexpr std::int64_t kDay = 86'400'000 * kMs;
  for (const std::int64_t wrong_ns : {5 * kDay, -5 * kDay, 2'000 * kMs}) {
    for (const std::size_t at : {0, 3, 6, 9}) {
      if (at == 0 && wrong_ns < kDay && wrong_ns > -kDay)
        continue;  // Then all times count from it.
      auto messages = RegularMessages(30, 101 * kMs);
      messages[at].stamp_ns += wrong_ns;
      Excerpt excerpt(Open(FakeClouds({"/cloud"}, messages)), 500 * kMs, 300 * kMs);
      std::vector<std::int64_t> recorded_ms;
      for (const LidarScan& scan : ReadAll(&excerpt)) {
        recorded_ms.push_back((*scan.recorded_ns - kStart) / kMs - 101);
      }
      // The step to a wrong stamp and back does not count, or counts twice: one scan more or less.
      ASSERT_GE(recorded_ms.size(), 2u) << wrong_ns << " at " << at;
      EXPECT_LE(std::abs(recorded_ms.front() - 500), 200) << wrong_ns << " at " << at;
      EXPECT_LE(std::abs(recorded_ms.back() - 700), 200) << wrong_ns << " at " << at;
    }
  }
}

TEST(Excerpt, IsThatOfTheStampsAcrossALongPauseBelowAMinute) {
  auto messages = RegularMessages(30, 101 * kMs);
  for (std::size_t i = 10; i < 30; ++i) messages[i].stamp_ns += 30'000 * kMs;
  Excerpt excerpt(Open(FakeClouds({"/cloud"}, messages)), 31'000 * kMs, 200 * kMs);
  EXPECT_EQ(ReadAll(&excerpt).size(), 2u);
}

}  // namespace
}  // namespace trajlo
