// SPDX-License-Identifier: MIT
// SQLite files and folders of rosbag2: whole, compressed, split, cut and broken.
#include "core/io/ros2/rosbag2_reader.h"

#include <gmock/gmock.h>
#include <sqlite3.h>

#include <algorithm>
#include <random>

#include "core/io/errors.h"
#include "core/io/ros2/db3_reader.h"
#include "core/io/ros2/rosbag2_metadata.h"
#include "tests/core/io/ros2/ros2_testing.h"

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::size_t kMessages = 7;

class Folder : public ::testing::TestWithParam<const char*> {};

TEST_P(Folder, ListsTopicsWithTypesAndCounts) {
  Rosbag2Reader reader(Fixture(GetParam()));
  ASSERT_EQ(reader.topics().size(), 4U);
  EXPECT_EQ(FindTopic(reader, "/velodyne")->type, "sensor_msgs/PointCloud2");
  EXPECT_EQ(FindTopic(reader, "/livox")->type, "livox_ros_driver2/CustomMsg");
  EXPECT_EQ(FindTopic(reader, "/pose")->messages, 2U);
  EXPECT_EQ(FindTopic(reader, "/ouster_new")->messages, 1U);
}

TEST_P(Folder, GivesOnlyWhatIsSelectedInTheOrderOfRecording) {
  Rosbag2Reader reader(Fixture(GetParam()));
  const auto wanted = static_cast<std::size_t>(FindTopic(reader, "/pose") - &reader.topics()[0]);
  reader.Select({wanted});
  const auto messages = ReadAll(&reader);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].topic, "/pose");
  EXPECT_EQ(messages[0].recorded_ns, 1'600'000'000'100'000'000);
  EXPECT_EQ(messages[1].recorded_ns, 1'600'000'000'200'000'000);
  EXPECT_FALSE(reader.report().damaged);
  EXPECT_THAT(reader.report().warnings, IsEmpty());
}

TEST_P(Folder, WithoutMetadataIsReadByTheNamesOfItsFiles) {
  const TempFolder folder;
  for (const auto& entry : std::filesystem::directory_iterator(Fixture(GetParam()))) {
    if (entry.path().extension() != ".yaml") std::filesystem::copy(entry.path(), folder.path());
  }
  Rosbag2Reader reader(folder.path());
  EXPECT_EQ(FindTopic(reader, "/pose")->messages, 2U);
  EXPECT_EQ(ReadAll(&reader), ReadAll(Fixture(GetParam())));
  EXPECT_FALSE(reader.report().damaged);
  EXPECT_THAT(reader.report().warnings, ElementsAre(HasSubstr("there is no metadata.yaml")));
}

TEST_P(Folder, LeavesNothingBehind) {
  const TempFolder folder;
  const char* set = std::getenv("TMPDIR");
  const std::string old = set != nullptr ? set : "";
  setenv("TMPDIR", folder.path().c_str(), 1);
  const auto messages = ReadAll(Fixture(GetParam()));
  old.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", old.c_str(), 1);
  EXPECT_EQ(messages.size(), kMessages);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(Folders, Folder,
                         ::testing::Values("plain_db3", "file_zstd_db3", "message_zstd_db3",
                                           "split_db3"));

TEST(Rosbag2Reader, MissingFilesOfASplitRecordingAreReportedAndPassedOver) {
  const TempFolder folder;
  std::filesystem::copy(Fixture("split_db3"), folder.path());
  std::filesystem::remove(folder.path() / "split_0.db3.zstd");
  Rosbag2Reader reader(folder.path());
  EXPECT_EQ(ReadAll(&reader).size(), 3U);
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_THAT(reader.report().warnings.at(0), HasSubstr("split_0.db3"));
  std::filesystem::remove(folder.path() / "split_1.db3.zstd");
  EXPECT_THROW(Rosbag2Reader{folder.path()}, InputError);
}

TEST(Rosbag2Reader, BrokenMetadataDoNotMatter) {
  const TempFolder folder;
  std::filesystem::copy(Fixture("split_db3"), folder.path());
  for (const char* text : {"", "a: [", "rosbag2_bagfile_information: 3", "\xFF\xFE"}) {
    folder.Write("metadata.yaml", text);
    EXPECT_EQ(ReadAll(folder.path()).size(), kMessages) << text;
  }
}

TEST(Rosbag2Reader, AFolderOfNoRecordingIsAnError) {
  const TempFolder folder;
  EXPECT_FALSE(IsRos2Bag(folder.path()));
  EXPECT_THROW(Rosbag2Reader{folder.path()}, InputError);
  folder.Write("a.bag", "#ROSBAG V2.0\n");
  EXPECT_FALSE(IsRos2Bag(folder.path()));
  EXPECT_FALSE(IsRos2Bag(folder.path() / "a.bag"));
  EXPECT_TRUE(IsRos2Bag(Fixture("plain_db3")));
  EXPECT_TRUE(IsRos2Bag(Fixture("zstd.mcap")));
  EXPECT_TRUE(IsRos2Bag("recording/a_0.db3.zstd"));
}

TEST(Rosbag2Reader, NumbersInNamesOrderSplitFiles) {
  const TempFolder folder;
  for (const char* name : {"a_10.db3", "a_009.db3", "a_100.db3", "a_0.db3"}) folder.Write(name, "");
  std::vector<std::string> names;
  for (const auto& file : ReadRosbag2Folder(folder.path()).files) names.push_back(file.filename());
  EXPECT_THAT(names, ElementsAre("a_0.db3", "a_009.db3", "a_10.db3", "a_100.db3"));
}

TEST(Db3Reader, ReadsInTheOrderOfTheRecordingTimesNotOfTheRows) {
  std::vector<std::int64_t> times;
  for (const auto& message : ReadAll(Fixture("plain_db3/plain_db3.db3"))) {
    times.push_back(message.recorded_ns);
  }
  ASSERT_EQ(times.size(), kMessages);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_LT(times.front(), times.back());
}

class BrokenDb3 : public ::testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path File() const {
    return Fixture(GetParam()) / (std::string(GetParam()) + ".db3");
  }
};

TEST_P(BrokenDb3, CutAnywhereGivesMessagesOfTheWholeFileOrAnError) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(File());
  const auto all = ReadAll(File());
  std::size_t most = 0;
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    const auto file = folder.Write("cut.db3", whole.substr(0, size));
    try {
      Db3Reader reader(file);
      const auto messages = ReadAll(&reader);
      for (const auto& message : messages) {
        ASSERT_EQ(std::count(all.begin(), all.end(), message), 1) << size;
      }
      most = std::max(most, messages.size());
      ASSERT_TRUE(reader.report().damaged) << size;
      ASSERT_EQ(reader.report().bytes_lost, whole.size() - size);
      ASSERT_THAT(reader.report().warnings.at(0), HasSubstr("the file is cut off"));
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
  EXPECT_GE(most, kMessages - 2);
}

TEST_P(BrokenDb3, WithFlippedBytesNeitherCrashesNorInventsMessages) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(File());
  std::mt19937 random(7);
  for (int trial = 0; trial < 150; ++trial) {
    std::string broken = whole;
    for (int flips = 0; flips < 1 + trial % 5; ++flips) {
      broken[random() % broken.size()] ^= static_cast<char>(1U << random() % 8);
    }
    const auto file = folder.Write("flipped.db3", broken);
    try {
      RosCloudReader reader(std::make_unique<Db3Reader>(file), file);
      CloudMessage cloud;
      std::size_t clouds = 0;
      while (reader.Next(&cloud)) {
        ++clouds;
        for (const Column& column : cloud.table.columns) Values(cloud.table, column.name);
      }
      ASSERT_LE(clouds, 2 * kMessages);
    } catch (const InputError&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, BrokenDb3, ::testing::Values("plain_db3", "message_zstd_db3"));

TEST(BrokenDb3Zstd, CutAnywhereGivesWhatUnpacksOrAnError) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("file_zstd_db3/file_zstd_db3.db3.zstd"));
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    const auto file = folder.Write("cut.db3.zstd", whole.substr(0, size));
    try {
      Rosbag2Reader reader(file);
      EXPECT_LE(ReadAll(&reader).size(), kMessages);
      EXPECT_TRUE(reader.report().damaged) << size;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
}

TEST(Db3Reader, WhatAKilledRecorderLeftBesideTheFileIsRead) {
  const TempFolder folder;
  const auto file = folder.path() / "live.db3";
  std::filesystem::copy(Fixture("plain_db3/plain_db3.db3"), file);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  const char* sql =
      "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0;"
      "INSERT INTO messages (topic_id, timestamp, data)"
      "  SELECT topic_id, timestamp + 1000000000, data FROM messages;";
  ASSERT_EQ(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), SQLITE_OK);
  const TempFolder killed;
  std::filesystem::copy(file, killed.path() / "live.db3");
  std::filesystem::copy(file.string() + "-wal", killed.path() / "live.db3-wal");
  sqlite3_close(database);
  Db3Reader reader(killed.path() / "live.db3");
  EXPECT_EQ(ReadAll(&reader).size(), 2 * kMessages);
  EXPECT_FALSE(reader.report().damaged);
}

TEST(Db3Reader, OtherDatabasesAndFilesAreErrorsThatSayWhatIsMissing) {
  const TempFolder folder;
  const auto message = [&](const std::string& bytes) -> std::string {
    try {
      Db3Reader(folder.Write("a.db3", bytes));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(""), HasSubstr("this is not an SQLite database"));
  EXPECT_THAT(message("#ROSBAG V2.0"), HasSubstr("this is not an SQLite database"));
  EXPECT_THAT(message(testing::ReadFile(Fixture("plain_db3/plain_db3.db3")).substr(0, 600)),
              HasSubstr("SQLite cannot read it"));
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "other.db3").c_str(), &other), SQLITE_OK);
  sqlite3_exec(other, "CREATE TABLE topics (id)", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_THAT(message(testing::ReadFile(folder.path() / "other.db3")),
              HasSubstr("no tables 'topics' and 'messages'"));
  std::string renamed = testing::ReadFile(Fixture("plain_db3/plain_db3.db3"));
  const auto at = renamed.find("CREATE TABLE topics");
  ASSERT_NE(at, std::string::npos);
  renamed.replace(at, 19, "CREATE TROUBLE here");
  EXPECT_THAT(message(renamed), HasSubstr("malformed database schema"));
}

}  // namespace
}  // namespace trajlo
