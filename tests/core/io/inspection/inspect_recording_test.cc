// SPDX-License-Identifier: MIT
#include "core/io/inspection/inspect_recording.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/inspection/findings.h"
#include "tests/core/io/recording/fake_clouds.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

RecordingInspection Inspect(const std::vector<std::string>& names,
                            const std::vector<FakeMessage>& messages, MessageReport at_end = {},
                            const InspectionOptions& options = {}) {
  return InspectClouds(
      "fake.bag", [&] { return std::make_unique<FakeClouds>(names, messages, at_end); }, options);
}

TEST(InspectClouds, SeesWhatTrajloRunWouldSee) {
  const RecordingInspection found = Inspect({"/cloud", "/tf"}, RegularMessages(8, 100 * kMs));
  ASSERT_EQ(found.topics.size(), 2u);
  ASSERT_EQ(found.clouds.size(), 1u);
  const CloudInspection& cloud = found.clouds[0];
  EXPECT_EQ(cloud.topic, "/cloud");
  EXPECT_EQ(cloud.messages_read, 8u);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.fields[3].name, "t");
  EXPECT_EQ(cloud.fields[3].type, "uint32");
  EXPECT_EQ(cloud.fields[3].offset, 12u);
  EXPECT_EQ(cloud.convention.unit, TimeUnit::kNanoseconds);
  EXPECT_EQ(cloud.convention.stamp_at, StampAt::kStart);
  EXPECT_EQ(cloud.points.total, 80u);
  EXPECT_NEAR(cloud.points.range_max_m, 10.0, 1e-6);
  ASSERT_TRUE(cloud.sweeps);
  EXPECT_NEAR(cloud.sweeps->span_s, 0.09, 1e-9);
  EXPECT_NEAR(cloud.sweeps->pause_s, 0.01, 1e-9);
  EXPECT_NEAR(found.duration_s, 0.7, 1e-9);
  EXPECT_FALSE(found.damaged);
}

TEST(InspectClouds, TellsStampsAtTheEndByTheTimeOfRecording) {
  const RecordingInspection found = Inspect({"/cloud"}, RegularMessages(8, 2 * kMs));
  const CloudInspection& cloud = found.clouds[0];
  EXPECT_EQ(cloud.convention.stamp_at, StampAt::kEnd);
  EXPECT_NEAR(cloud.sweeps->stamp_after_first_s, 0.1, 1e-6);
  EXPECT_NEAR(cloud.stamps.recorded_after_s->median, 0.002, 1e-9);
}

TEST(InspectClouds, FindsThatNothingTellsWhichEndStampsMark) {
  const RecordingInspection found = Inspect({"/cloud"}, RegularMessages(8, 0));
  EXPECT_THAT(FindingsOf(found.clouds[0]), Contains(HasSubstr("set input.stamp_at=end")));
}

TEST(InspectClouds, GivesThePhaseOfFurtherLidars) {
  std::vector<FakeMessage> messages;
  for (const FakeMessage& message : RegularMessages(8, 100 * kMs)) {
    messages.push_back(message);
    messages.push_back({1, message.stamp_ns + 37 * kMs, message.recorded_ns + 37 * kMs});
  }
  const RecordingInspection found = Inspect({"/cloud_a", "/cloud_b"}, messages);
  ASSERT_EQ(found.clouds.size(), 2u);
  EXPECT_FALSE(found.clouds[0].phase);
  ASSERT_TRUE(found.clouds[1].phase);
  EXPECT_NEAR(found.clouds[1].phase->after_first_lidar_s, 0.037, 1e-9);
}

TEST(InspectClouds, GoesOnWithoutTimesWhereTrajloRunWouldRefuse) {
  std::vector<FakeMessage> messages = RegularMessages(8, 100 * kMs);
  // A scan every 10 s, whose points last 0.09 s if they are ns and 90 s if they are us.
  for (std::size_t i = 0; i < messages.size(); ++i) {
    messages[i].stamp_ns = messages[i].recorded_ns =
        static_cast<std::int64_t>(1 + i) * 10'000 * kMs;
  }
  const RecordingInspection found = Inspect({"/cloud"}, messages);
  const CloudInspection& cloud = found.clouds[0];
  EXPECT_THAT(cloud.time_problem, HasSubstr("ambiguous point times"));
  EXPECT_EQ(cloud.points.total, 80u);
  EXPECT_FALSE(cloud.sweeps);
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("trajlo_run will refuse")));
}

TEST(InspectClouds, DamageIsToldAndWhatCanBeReadIsShown) {
  std::vector<FakeMessage> messages = RegularMessages(8, 100 * kMs);
  messages[6].x = "distance";
  MessageReport report;
  report.damaged = true;
  report.bytes_lost = 42;
  report.warnings = {"the file is cut"};
  const RecordingInspection found = Inspect({"/cloud"}, messages, report);
  EXPECT_TRUE(found.damaged);
  EXPECT_EQ(found.bytes_lost, 42u);
  EXPECT_THAT(found.warnings, Contains("the file is cut"));
  EXPECT_EQ(found.clouds[0].messages_unreadable, 1u);
  EXPECT_EQ(found.clouds[0].stamps.count, 7u);
  EXPECT_THAT(FindingsOf(found.clouds[0]), Contains(HasSubstr("1 message cannot be read")));
}

TEST(InspectClouds, QuickReadsTheFirstMessagesOnly) {
  InspectionOptions options;
  options.messages_per_lidar = 3;
  std::size_t most = 0, listed = 0;
  options.on_progress = [&](std::size_t done, std::size_t all) {
    most = done;
    listed = all;
  };
  const RecordingInspection found = Inspect({"/cloud"}, RegularMessages(50, kMs), {}, options);
  EXPECT_TRUE(found.is_quick);
  EXPECT_EQ(found.clouds[0].messages_read, 3u);
  EXPECT_EQ(found.clouds[0].messages_listed, 50u);
  EXPECT_EQ(most, 3u);
  EXPECT_EQ(listed, 3u);
}

TEST(InspectClouds, ABagWithoutCloudsIsNoError) {
  const RecordingInspection found = Inspect({"/tf"}, {});
  EXPECT_EQ(found.topics.size(), 1u);
  EXPECT_TRUE(found.clouds.empty());
}

TEST(InspectRecording, AFolderOfScansIsALidar) {
  const TempFolder folder;
  RoomRecording room;
  room.columns = 60;
  room.Write(folder.path());
  WriteFile(RoomRecording::File(folder.path(), 4), "no scan");
  const RecordingInspection found = InspectRecording(folder.path().string(), {});
  ASSERT_EQ(found.clouds.size(), 1u);
  const CloudInspection& cloud = found.clouds[0];
  EXPECT_EQ(cloud.type, ".pcd files");
  EXPECT_EQ(cloud.messages_listed, 12u);
  EXPECT_EQ(cloud.messages_read, 11u);
  EXPECT_TRUE(found.damaged);
  EXPECT_EQ(cloud.stamps.missing, 1u);
  EXPECT_EQ(cloud.convention.unit, TimeUnit::kSeconds);
  EXPECT_FALSE(cloud.stamp_is_assumed);
  EXPECT_FALSE(cloud.stamps.recorded_after_s);
}

TEST(InspectRecording, TheFoldersOfARigAreItsLidars) {
  const TempFolder folder;
  RoomRecording room;
  room.columns = 60;
  room.scans = 6;
  room.Write(folder / "lidar0");
  room.Write(folder / "lidar1");
  std::filesystem::remove(folder / "lidar1" / "timestamps.txt");
  const RecordingInspection found = InspectRecording(folder.path().string(), {});
  ASSERT_EQ(found.clouds.size(), 2u);
  EXPECT_TRUE(found.clouds[1].stamp_is_assumed);
  EXPECT_THAT(FindingsOf(found.clouds[1]), Contains(HasSubstr("an even count is assumed")));
}

TEST(InspectRecording, WhatIsNotThereIsAnInputError) {
  EXPECT_THROW(InspectRecording("/nowhere/at/all", {}), InputError);
}

}  // namespace
}  // namespace trajlo::testing
