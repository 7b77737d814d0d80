// SPDX-License-Identifier: MIT
// MCAP files that are whole, cut at any place, broken, or made to harm.
#include "core/io/ros2/mcap_reader.h"

#include <gmock/gmock.h>

#include <random>

#include "core/io/errors.h"
#include "tests/core/io/ros2/ros2_testing.h"

namespace trajlo {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

constexpr std::size_t kMessages = 22;

/// DataEnd, the record 0x0F of 4 bytes behind which the summary begins.
std::size_t FindDataEnd(const std::string& whole) {
  return whole.rfind(std::string("\x0F\x04\0\0\0\0\0\0\0", 9));
}

class WholeFile : public ::testing::TestWithParam<const char*> {};

TEST_P(WholeFile, ListsTopicsWithTypesAndCounts) {
  McapReader reader(Fixture(GetParam()));
  EXPECT_EQ(reader.topics().size(), 19U);
  const Topic* livox = FindTopic(reader, "/livox");
  ASSERT_NE(livox, nullptr);
  EXPECT_EQ(livox->type, "livox_ros_driver2/CustomMsg");
  EXPECT_EQ(livox->encoding, Encoding::kCdr);
  EXPECT_EQ(livox->messages, 2U);
  EXPECT_EQ(FindTopic(reader, "/hesai")->messages, 1U);
}

TEST_P(WholeFile, GivesOnlyWhatIsSelected) {
  McapReader reader(Fixture(GetParam()));
  const auto wanted = static_cast<std::size_t>(FindTopic(reader, "/pose") - &reader.topics()[0]);
  reader.Select({wanted});
  const auto messages = ReadAll(&reader);
  EXPECT_EQ(messages.size(), 2U);
  for (const auto& message : messages) EXPECT_EQ(message.topic, "/pose");
  EXPECT_FALSE(reader.report().damaged);
  EXPECT_THAT(reader.report().warnings, ::testing::IsEmpty());
}

TEST_P(WholeFile, CutAnywhereGivesAPrefixOfItsMessagesThatGrowsWithTheFile) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture(GetParam()));
  const auto all = ReadAll(Fixture(GetParam()));
  const std::size_t data_end = FindDataEnd(whole);
  std::size_t previous = 0;
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    const auto file = folder.Write("cut.mcap", whole.substr(0, size));
    try {
      McapReader reader(file);
      const auto messages = ReadAll(&reader);
      ASSERT_LE(messages.size(), all.size()) << size;
      ASSERT_GE(messages.size(), previous) << "fewer messages in a longer file, " << size;
      ASSERT_TRUE(std::equal(messages.begin(), messages.end(), all.begin())) << size;
      previous = messages.size();
      if (size < data_end) {
        ASSERT_TRUE(reader.report().damaged) << size;
        ASSERT_THAT(reader.report().warnings, Each(HasSubstr(file.string())));
      }
    } catch (const InputError& error) {
      ASSERT_EQ(previous, 0U) << "messages are lost in a longer file, " << size;
      ASSERT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
  EXPECT_EQ(previous, kMessages);
}

TEST_P(WholeFile, WithFlippedBytesNeitherCrashesNorInventsMessages) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture(GetParam()));
  std::mt19937 random(7);
  for (int trial = 0; trial < 150; ++trial) {
    std::string broken = whole;
    for (int flips = 0; flips < 1 + trial % 3; ++flips) {
      broken[random() % broken.size()] ^= static_cast<char>(1U << random() % 8);
    }
    const auto file = folder.Write("flipped.mcap", broken);
    try {
      RosCloudReader reader(std::make_unique<McapReader>(file), file);
      CloudMessage cloud;
      std::size_t clouds = 0;
      while (reader.Next(&cloud)) {
        ++clouds;
        for (const Column& column : cloud.table.columns) Values(cloud.table, column.name);
      }
      ASSERT_LE(clouds, kMessages);
    } catch (const InputError&) {
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Files, WholeFile,
                         ::testing::Values("none.mcap", "zstd.mcap", "lz4.mcap", "unchunked.mcap"),
                         [](const auto& param) {
                           const std::string name = param.param;
                           return name.substr(0, name.find('.'));
                         });

TEST(McapReader, AFileOfAKilledRecorderHasAllTopicsCountsAndMessages) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("zstd.mcap"));
  McapReader reader(folder.Write("killed.mcap", whole.substr(0, FindDataEnd(whole))));
  EXPECT_EQ(reader.topics().size(), 19U);
  EXPECT_EQ(FindTopic(reader, "/velodyne")->messages, 2U);
  EXPECT_EQ(ReadAll(&reader), ReadAll(Fixture("zstd.mcap")));
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_EQ(reader.report().bytes_lost, 0U);
  EXPECT_THAT(reader.report().warnings.at(0), HasSubstr("ends without its end mark"));
}

TEST(McapReader, AFileThatIsCutBehindItsMessagesLosesNothingAndSaysSo) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("zstd.mcap"));
  const std::size_t data_end = FindDataEnd(whole) + 13;
  for (const std::size_t size : {data_end, data_end + 300, whole.size() - 20, whole.size() - 1}) {
    McapReader reader(folder.Write("cut.mcap", whole.substr(0, size)));
    EXPECT_EQ(ReadAll(&reader).size(), kMessages) << size;
    EXPECT_FALSE(reader.report().damaged) << size;
    ASSERT_EQ(reader.report().warnings.size(), 1U) << size;
    EXPECT_THAT(reader.report().warnings[0], HasSubstr("the end of the file is cut off")) << size;
  }
}

/// A look at the first messages says it, too.
TEST(McapReader, AFileThatIsCutSaysSoBeforeItsMessagesAreReadAndNotTwice) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("zstd.mcap"));
  const std::size_t data_end = FindDataEnd(whole);
  for (const std::size_t size : {data_end - 100, data_end, whole.size() - 1}) {
    McapReader reader(folder.Write("cut.mcap", whole.substr(0, size)));
    const MessageReport before = reader.report();
    EXPECT_EQ(before.damaged, size <= data_end) << size;
    EXPECT_THAT(before.warnings, ::testing::SizeIs(1)) << size;
    ReadAll(&reader);
    EXPECT_EQ(reader.report().warnings, before.warnings) << size;
    EXPECT_EQ(reader.report().bytes_lost, before.bytes_lost) << size;
  }
}

TEST(McapReader, AFileThatIsCompleteButHasNoSummaryIsNotDamaged) {
  const TempFolder folder;
  const std::string whole = testing::ReadFile(Fixture("none.mcap"));
  const std::string footer = std::string("\x02\x14\0\0\0\0\0\0\0", 9) + std::string(20, '\0');
  McapReader reader(folder.Write(
      "plain.mcap", whole.substr(0, FindDataEnd(whole) + 13) + footer + whole.substr(0, 8)));
  EXPECT_EQ(FindTopic(reader, "/velodyne")->messages, 2U);
  EXPECT_EQ(ReadAll(&reader).size(), kMessages);
  EXPECT_FALSE(reader.report().damaged);
  EXPECT_THAT(reader.report().warnings, ::testing::IsEmpty());
}

TEST(McapReader, AChunkWithAWrongChecksumIsSkippedAndTheNextOneRead) {
  const TempFolder folder;
  std::string broken = testing::ReadFile(Fixture("none.mcap"));
  const auto x_of_first_cloud = broken.find("lidar") + 200;
  broken[x_of_first_cloud] ^= 1;
  McapReader reader(folder.Write("crc.mcap", broken));
  const auto messages = ReadAll(&reader);
  EXPECT_GT(messages.size(), 0U);
  EXPECT_LT(messages.size(), kMessages);
  EXPECT_TRUE(reader.report().damaged);
  EXPECT_GT(reader.report().bytes_lost, 1000U);
  EXPECT_THAT(reader.report().warnings.at(0), HasSubstr("checksum is wrong"));
  EXPECT_THAT(reader.report().warnings.at(1), HasSubstr("the file lists 22 messages"));
}

TEST(McapReader, BehindABrokenLengthTheIndexShowsTheNextChunk) {
  const TempFolder folder;
  std::string broken = testing::ReadFile(Fixture("lz4.mcap"));
  // Behind the magic and the header's record stands the first chunk: break its length.
  const auto first_chunk = 8 + 9 + static_cast<unsigned char>(broken[9]);
  ASSERT_EQ(broken[first_chunk], 0x06);
  broken[first_chunk + 6] = 0x7F;
  McapReader reader(folder.Write("length.mcap", broken));
  const auto messages = ReadAll(&reader);
  EXPECT_GT(messages.size(), kMessages / 2);
  EXPECT_LT(messages.size(), kMessages);
  EXPECT_THAT(reader.report().warnings.at(0), HasSubstr("goes on at the next chunk"));
}

TEST(McapReader, AChunkThatClaimsToUnpackToMoreThanItHoldsAllocatesNoMoreThanComesOut) {
  const TempFolder folder;
  for (const char* name : {"zstd.mcap", "lz4.mcap"}) {
    std::string broken = testing::ReadFile(Fixture(name));
    const auto first_chunk = 8 + 9 + static_cast<unsigned char>(broken[9]);
    for (int k = 0; k < 8; ++k) broken[first_chunk + 9 + 16 + k] = '\x7F';
    McapReader reader(folder.Write("bomb.mcap", broken));
    EXPECT_GT(ReadAll(&reader).size(), kMessages / 2);
    EXPECT_THAT(reader.report().warnings.at(0), HasSubstr("size or checksum is wrong"));
  }
}

TEST(McapReader, OtherFilesAreErrorsThatSayWhatIsMissing) {
  const TempFolder folder;
  const auto message = [&](const std::string& bytes) -> std::string {
    try {
      McapReader(folder.Write("a.mcap", bytes));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(""), HasSubstr("does not begin with the format's mark"));
  EXPECT_THAT(message("#ROSBAG V2.0"), HasSubstr("this is not an MCAP file"));
  EXPECT_THAT(message(testing::ReadFile(Fixture("none.mcap")).substr(0, 60)),
              HasSubstr("no channel is in the 60 bytes"));
  EXPECT_THROW(McapReader(folder.path() / "absent.mcap"), InputError);
  EXPECT_THROW(McapReader(folder.path()), InputError);
}

}  // namespace
}  // namespace trajlo
