// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "core/io/errors.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "core/io/ros1/ros1_bag_writer.h"
#include "tests/core/io/ros1/ros1_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::_;
using ::testing::ElementsAre;
using ::testing::FieldsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class FixtureBag : public ::testing::TestWithParam<const char*> {};

TEST_P(FixtureBag, GivesEveryByteInTheOrderOfRecordingThoughItsChunksOverlap) {
  Ros1BagReader reader(Fixture(GetParam()));
  EXPECT_THAT(
      reader.topics(),
      ElementsAre(
          FieldsAre("/points", "sensor_msgs/PointCloud2", Encoding::kRos1, 20U, "", _, _, _),
          FieldsAre("/pose", "geometry_msgs/PoseStamped", Encoding::kRos1, 40U, "", _, _, _)));
  EXPECT_EQ(ReadRest(&reader), FixtureMessages());
  EXPECT_FALSE(reader.report().damaged);
  EXPECT_EQ(reader.report().bytes_lost, 0U);
  EXPECT_THAT(reader.report().warnings, SizeIs(0));
  RawMessage message;
  EXPECT_FALSE(reader.Next(&message));
}

TEST_P(FixtureBag, GivesOnlyTheTopicsThatAreSelected) {
  for (const std::size_t topic : {0U, 1U}) {
    Ros1BagReader reader(Fixture(GetParam()));
    reader.Select({topic});
    std::vector<BagMessage> expected = FixtureMessages();
    const std::string& name = reader.topics()[topic].name;
    expected.erase(std::remove_if(expected.begin(), expected.end(),
                                  [&](const BagMessage& m) { return m.topic != name; }),
                   expected.end());
    EXPECT_EQ(ReadRest(&reader), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FixtureBag, ::testing::Values("none.bag", "bz2.bag", "lz4.bag"),
                         [](const auto& param) {
                           return std::filesystem::path(param.param).stem().string();
                         });

TEST(Reader, MergesMoreOverlappingChunksThanItHoldsAtOnce) {
  // Two topics written one behind the other, 100 MB each.
  const TempFolder folder;
  const MessageDescription type{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1",
                                "string data\n"};
  constexpr int kCount = 100;
  const std::string megabyte(1U << 20U, 'x');
  Ros1BagWriter writer(folder / "a.bag", {BagCompression::kLz4});
  for (const int topic : {0, 1}) {
    for (int i = 0; i < kCount; ++i) {
      // Even stamps ascend; the odd ones of the other topic descend, so that nothing can be let go.
      const int stamp = topic == 0 ? 2 * i : 2 * (kCount - i) - 1;
      writer.Write({topic == 0 ? "/a" : "/b", type}, stamp, megabyte + std::to_string(stamp));
    }
  }
  writer.Close();
  Ros1BagReader reader(folder / "a.bag");
  RawMessage message;
  for (int stamp = 0; stamp < 2 * kCount; ++stamp) {
    ASSERT_TRUE(reader.Next(&message));
    EXPECT_EQ(message.recorded_ns, stamp);
    EXPECT_EQ(message.bytes.view().substr(megabyte.size()), std::to_string(stamp));
  }
  EXPECT_FALSE(reader.Next(&message));
}

/// Adds to the eight bytes behind each `name` in `bag`.
void AddToFields(const std::string& name, std::uint64_t shift, std::string* bag) {
  for (std::size_t at = bag->find(name); at != bag->npos; at = bag->find(name, at + 1)) {
    std::uint64_t value = 0;
    std::memcpy(&value, &(*bag)[at + name.size()], sizeof(value));
    value += shift;
    std::memcpy(&(*bag)[at + name.size()], &value, sizeof(value));
  }
}

TEST(Reader, FindsMessagesBehindTheFirstFourGigabytes) {
  const TempFolder folder;
  std::string bag = ReadFile(Fixture("none.bag"));
  // A hole in the file between the header and the first chunk.
  constexpr std::size_t kHeaderEnd = 13 + 4096;
  constexpr std::uint64_t kHole = 5'000'000'000;
  AddToFields("chunk_pos=", kHole, &bag);
  AddToFields("index_pos=", kHole, &bag);
  const auto path = folder / "large.bag";
  WriteFile(path, bag.substr(0, kHeaderEnd));
  std::filesystem::resize_file(path, kHeaderEnd + kHole);
  std::ofstream(path, std::ios::binary | std::ios::app) << bag.substr(kHeaderEnd);
  Ros1BagReader reader(path);
  EXPECT_EQ(ReadRest(&reader), FixtureMessages());
  EXPECT_FALSE(reader.report().damaged);
}

TEST(Reader, RefusesWhatIsNoBagAndSaysWhatItIs) {
  const TempFolder folder;
  const std::pair<std::string, std::string> cases[] = {
      {"", "not a ROS 1 bag"},
      {"ply\nformat ascii", "not a ROS 1 bag"},
      {"#ROSBAG V1.2\n", "before 2010"},
      {"#ROSBAG V2.0\n", "no message"},
  };
  for (const auto& [content, complaint] : cases) {
    WriteFile(folder / "a.bag", content);
    try {
      Ros1BagReader reader(folder / "a.bag");
      ADD_FAILURE() << content;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(complaint));
      EXPECT_THAT(error.what(), HasSubstr("a.bag"));
    }
  }
  EXPECT_THROW(Ros1BagReader(folder / "none.bag"), InputError);
  EXPECT_THROW(Ros1BagReader(folder.path()), InputError);
}

TEST(Reader, RefusesAnEncryptedBag) {
  const TempFolder folder;
  std::string bag = ReadFile(Fixture("none.bag"));
  const std::string field("\x0e\0\0\0encryptor=gpg!", 18);
  // The header's length stands behind the first line, its fields behind that.
  bag[13] = static_cast<char>(bag[13] + field.size());
  bag.insert(17, field);
  WriteFile(folder / "a.bag", bag);
  try {
    Ros1BagReader reader(folder / "a.bag");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("encrypted"));
  }
}

}  // namespace
}  // namespace trajlo::testing
