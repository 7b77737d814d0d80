// SPDX-License-Identifier: MIT
// What is written is what is read. Foreign readers look at it in tests/scripts/test_exports.py.
#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/ros2/db3_reader.h"
#include "core/io/ros2/db3_writer.h"
#include "core/io/ros2/mcap_index.h"
#include "core/io/ros2/mcap_reader.h"
#include "core/io/ros2/mcap_writer.h"
#include "tests/core/io/ros2/ros2_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using testing::ReadFile;
using testing::TempFolder;
using testing::WriteFile;

const TopicDescription kTf{"/tf", TfMessageDescription()};
const TopicDescription kStatic{"/tf_static", TfMessageDescription(), true};
const TopicDescription kCloud{"/points", PointCloud2Description()};

/// This many messages, those of /tf_static and one of /points at the start though written last.
std::vector<NamedMessage> WriteMessages(int count, BagWriter* bag) {
  std::vector<NamedMessage> messages;
  const auto write = [&](const TopicDescription& topic, std::int64_t t_ns, std::size_t size) {
    const std::string bytes = std::string("\0\1\0\0", 4) + std::string(size, 'x');
    bag->Write(topic, t_ns, bytes);
    messages.push_back({topic.name, topic.message.type, t_ns, bytes});
  };
  constexpr std::int64_t kBeginNs = 1'700'000'000'000'000'000;
  for (int i = 0; i < count; ++i) {
    write(i % 3 == 0 ? kCloud : kTf, kBeginNs + i * 100'000'000LL, i % 3 == 0 ? 5000 : 40);
  }
  write(kStatic, kBeginNs, 12);
  write(kCloud, kBeginNs, 100'000);
  return messages;
}

std::vector<NamedMessage> ByTime(std::vector<NamedMessage> messages) {
  std::stable_sort(messages.begin(), messages.end(), [](const auto& a, const auto& b) {
    return std::tie(a.recorded_ns, a.topic, a.bytes) < std::tie(b.recorded_ns, b.topic, b.bytes);
  });
  return messages;
}

void ExpectTopicsAreDescribed(const RawMessageReader& reader) {
  ASSERT_EQ(reader.topics().size(), 3u);
  const Topic* cloud = FindTopic(reader, "/points");
  EXPECT_EQ(cloud->type, "sensor_msgs/PointCloud2");
  EXPECT_EQ(cloud->messages, 35u);
  EXPECT_EQ(cloud->interface.language, "ros2msg");
  EXPECT_EQ(cloud->interface.definition, Ros2Definition(PointCloud2Description().definition));
  EXPECT_FALSE(cloud->is_latched);
  EXPECT_TRUE(FindTopic(reader, "/tf_static")->is_latched);
}

TEST(McapWriter, WhatIsWrittenIsReadWithEveryCompression) {
  const TempFolder folder;
  const std::optional<Codec> codecs[] = {std::nullopt, Codec::kZstd, Codec::kLz4Frame};
  for (const auto& codec : codecs) {
    McapOptions options;
    options.compression = codec;
    options.chunk_bytes = 20'000;
    options.if_exists = IfExists::kReplace;
    McapWriter writer(folder / "a.mcap", options);
    const auto written = WriteMessages(102, &writer);
    writer.Close();
    McapReader reader(folder / "a.mcap");
    ExpectTopicsAreDescribed(reader);
    EXPECT_EQ(ReadAll(&reader), written);
    EXPECT_FALSE(reader.report().damaged);
    EXPECT_TRUE(reader.report().warnings.empty());
  }
}

TEST(McapWriter, MessagesThatComeLateHaveAChunkOfTheirOwn) {
  const TempFolder folder;
  McapOptions options;
  options.chunk_bytes = 20'000;
  McapWriter writer(folder / "a.mcap", options);
  WriteMessages(102, &writer);
  writer.Close();
  const auto file = std::make_shared<const RandomAccessFile>(folder / "a.mcap");
  const McapIndex index = ReadMcapIndex(file, folder / "a.mcap");
  EXPECT_GT(index.chunk_offsets.size(), 8u);
  // The last one: /tf_static and the late cloud.
  const std::uint64_t offset = index.chunk_offsets.back();
  const FileBytes bytes = file->Read(offset + 9, 24);
  std::uint64_t times[2];
  std::memcpy(times, bytes.data(), sizeof(times));
  EXPECT_EQ(times[0], times[1]);
}

TEST(McapWriter, AnEmptyFileIsWhole) {
  const TempFolder folder;
  McapWriter writer(folder / "a.mcap");
  writer.Close();
  const std::string bytes = ReadFile(folder / "a.mcap");
  EXPECT_EQ(bytes.substr(0, 8), bytes.substr(bytes.size() - 8));
  // The reader needs a topic.
  EXPECT_THROW(McapReader(folder / "a.mcap"), InputError);
}

TEST(McapWriter, TheSameMessagesGiveTheSameBytes) {
  const TempFolder folder;
  for (const char* name : {"a.mcap", "b.mcap"}) {
    McapWriter writer(folder / name);
    WriteMessages(30, &writer);
    writer.Close();
  }
  EXPECT_EQ(ReadFile(folder / "a.mcap"), ReadFile(folder / "b.mcap"));
}

TEST(McapWriter, ForeignQualitiesOfServiceAreKept) {
  const TempFolder folder;
  TopicDescription topic = kTf;
  topic.qos = "- history: keep_all\n  durability: transient_local\n";
  McapWriter mcap(folder / "a.mcap");
  Db3Writer db3(folder / "a.db3");
  for (BagWriter* bag : {static_cast<BagWriter*>(&mcap), static_cast<BagWriter*>(&db3)}) {
    bag->Write(topic, 1, "1234");
    bag->Close();
  }
  for (const char* name : {"a.mcap", "a.db3"}) {
    const Rosbag2Reader reader(folder / name);
    EXPECT_EQ(reader.topics()[0].qos, topic.qos);
    EXPECT_TRUE(reader.topics()[0].is_latched);
  }
}

TEST(Db3Writer, WhatIsWrittenIsReadByTime) {
  const TempFolder folder;
  Db3Writer writer(folder / "a.db3");
  const auto written = WriteMessages(102, &writer);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.db3"));
  writer.Close();
  Db3Reader reader(folder / "a.db3");
  ExpectTopicsAreDescribed(reader);
  EXPECT_EQ(ByTime(ReadAll(&reader)), ByTime(written));
  EXPECT_FALSE(reader.report().damaged);
}

TEST(Ros2Writers, NothingIsLeftOfWhatIsNotClosed) {
  const TempFolder folder;
  {
    McapWriter mcap(folder / "a.mcap");
    Db3Writer db3(folder / "a.db3");
    WriteMessages(5, &mcap);
    WriteMessages(5, &db3);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Ros2Writers, AnEarlierFileIsKeptUnlessAskedOtherwise) {
  const TempFolder folder;
  for (const char* name : {"a.mcap", "a.db3"}) WriteFile(folder / name, "precious");
  EXPECT_THROW(McapWriter(folder / "a.mcap"), OutputError);
  EXPECT_THROW(Db3Writer(folder / "a.db3"), OutputError);
  EXPECT_EQ(ReadFile(folder / "a.db3"), "precious");
  Db3Writer db3(folder / "a.db3", IfExists::kReplace);
  WriteMessages(5, &db3);
  db3.Close();
  EXPECT_EQ(ReadAll(folder / "a.db3").size(), 7u);
}

TEST(Ros2Writers, WhatCannotBeWrittenIsAnError) {
  const TempFolder folder;
  McapWriter mcap(folder / "a.mcap");
  EXPECT_THROW(mcap.Write(kTf, -1, "x"), OutputError);
  EXPECT_THROW(McapWriter(folder / "none" / "a.mcap"), OutputError);
  EXPECT_THROW(Db3Writer(folder / "none" / "a.db3"), OutputError);
  const auto fill_the_disk = [] {
    McapOptions options;
    options.chunk_bytes = 1000;
    McapWriter full("/dev/full", options);
    WriteMessages(10, &full);
  };
  EXPECT_THROW(fill_the_disk(), OutputError);
}

}  // namespace
}  // namespace trajlo
