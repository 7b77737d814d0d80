// SPDX-License-Identifier: MIT
#include "core/io/recording/open_recording.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using trajlo::testing::RoomRecording;
using trajlo::testing::TempFolder;

RoomRecording SmallRoom(int scans) {
  RoomRecording room;
  room.scans = scans;
  room.columns = 8;
  return room;
}

TEST(InputPaths, SeparatesByCommasOrTakesTheFoldersOfTheLidars) {
  const TempFolder temp;
  EXPECT_THAT(InputPaths("a,b,,c"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(InputPaths(""), ElementsAre());
  EXPECT_THAT(InputPaths(temp.path()), ElementsAre(temp.path().string()));
  std::filesystem::create_directories(temp / "a,b");
  EXPECT_THAT(InputPaths(temp / "a,b"), ElementsAre((temp / "a,b").string()));
  for (const char* name : {"lidar0", "lidar1", "lidar3"}) {
    std::filesystem::create_directories(temp / name);
  }
  EXPECT_THAT(InputPaths(temp.path()),
              ElementsAre((temp / "lidar0").string(), (temp / "lidar1").string()));
}

TEST(OpenRecording, MergesLidarsByTheStampsOfTheirScans) {
  const TempFolder temp;
  SmallRoom(4).Write(temp / "a");
  SmallRoom(2).Write(temp / "b");
  trajlo::testing::WriteFile(temp / "b/timestamps.txt", "1000.15\n1000.25\n");
  const auto recording = OpenRecording({temp / "a", temp / "b"}, {});
  EXPECT_EQ(recording->size(), 6u);
  EXPECT_THAT(recording->description(), HasSubstr("lidar 1 is 2 scans"));
  LidarScan scan;
  std::vector<std::pair<int, std::int64_t>> order;
  while (recording->Next(&scan)) {
    order.emplace_back(scan.lidar_id, scan.stamp_ns / 1'000'000 - 1'000'000);
  }
  using Scan = std::pair<int, std::int64_t>;
  EXPECT_THAT(order, ElementsAre(Scan(0, 0), Scan(0, 100), Scan(1, 150), Scan(0, 200), Scan(1, 250),
                                 Scan(0, 300)));
  EXPECT_EQ(recording->report().scans_read, 6u);
}

TEST(OpenRecording, OneFolderThatIsMissingIsAnError) {
  const TempFolder temp;
  SmallRoom(2).Write(temp / "a");
  EXPECT_THROW(OpenRecording({temp / "a", temp / "missing"}, {}), InputError);
}

}  // namespace
}  // namespace trajlo
