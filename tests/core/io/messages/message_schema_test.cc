// SPDX-License-Identifier: MIT
// Messages between ROS 1's encoding and CDR. The fixtures hold the same messages in both,
// serialised by rosbags.
#include "core/io/messages/message_schema.h"

#include <gmock/gmock.h>

#include "core/io/messages/message_description.h"
#include "core/io/messages/wire_writer.h"
#include "core/io/ros2/mcap_reader.h"

namespace trajlo {
namespace {

struct Entry {
  Topic topic;
  std::string bytes;
};

/// The first message of each topic.
std::map<std::string, Entry> FirstMessages(const std::string& fixture) {
  McapReader reader(std::string(TRAJLO_TEST_DIR) + "/../ros2/fixtures/" + fixture);
  std::map<std::string, Entry> messages;
  RawMessage raw;
  while (reader.Next(&raw)) {
    const Topic& topic = reader.topics()[raw.topic];
    messages.emplace(topic.name, Entry{topic, std::string(raw.bytes.view())});
  }
  return messages;
}

TEST(MessageSchema, BothWaysTheMessagesOfAForeignWriterComeOutByteByByte) {
  const auto ros1 = FirstMessages("ros1.mcap");
  const auto ros2 = FirstMessages("none.mcap");
  int compared = 0;
  for (const auto& [name, entry] : ros1) {
    const MessageDescription* known = FindDescription(entry.topic.type);
    if (known == nullptr) continue;
    const auto schema = MessageSchema::Parse(known->type, known->definition);
    ASSERT_TRUE(schema) << known->type;
    const std::string& cdr = ros2.at(name).bytes;
    EXPECT_EQ(schema->Rewrite(entry.bytes, Encoding::kRos1, Encoding::kCdr), cdr) << name;
    EXPECT_EQ(schema->Rewrite(cdr, Encoding::kCdr, Encoding::kRos1), entry.bytes) << name;
    // By the interface of ROS 2, too.
    const auto as_ros2 =
        MessageSchema::Parse(Ros2TypeName(known->type), Ros2Definition(known->definition));
    ASSERT_TRUE(as_ros2) << known->type;
    EXPECT_EQ(as_ros2->Rewrite(cdr, Encoding::kCdr, Encoding::kRos1), entry.bytes) << name;
    ++compared;
  }
  EXPECT_GE(compared, 10);
}

TEST(MessageSchema, BigEndianCdrIsRead) {
  const auto ros2 = FirstMessages("none.mcap");
  const MessageDescription& cloud = PointCloud2Description();
  const auto schema = MessageSchema::Parse(cloud.type, cloud.definition);
  const auto rewritten =
      schema->Rewrite(ros2.at("/big_endian_cdr").bytes, Encoding::kCdr, Encoding::kCdr);
  EXPECT_EQ(rewritten, ros2.at("/ouster_new").bytes);
}

TEST(MessageSchema, CutMessagesGiveNothing) {
  const auto ros1 = FirstMessages("ros1.mcap");
  const std::string& bytes = ros1.at("/odometry").bytes;
  const MessageDescription& odometry = OdometryDescription();
  const auto schema = MessageSchema::Parse(odometry.type, odometry.definition);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(schema->Rewrite(bytes.substr(0, size), Encoding::kRos1, Encoding::kCdr)) << size;
  }
  EXPECT_FALSE(schema->Rewrite(bytes + "x", Encoding::kRos1, Encoding::kCdr));
}

constexpr char kOdd[] =
    "# All that an interface may hold.\n"
    "int8 ONE=1   # a constant\n"
    "string NAME = \"a # b\"\n"
    "Header header\n"
    "  time[]   times # indented\n"
    "duration wait\n"
    "string<=8[2] names\n"
    "Nested[<=4] parts\n"
    "std_msgs/msg/Empty nothing\n"
    "uint16[3] numbers 7\n"
    "bool last true\n"
    "================================================================================\n"
    "MSG: own/Nested\n"
    "float64 value\n"
    "uint8 small\n"
    "================================================================================\n"
    "MSG: std_msgs/Empty\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\n"
    "uint32 seq\n"
    "time stamp\n"
    "string frame_id\n";

/// A message of kOdd in either encoding.
std::string OddMessage(Encoding encoding) {
  WireWriter out(encoding);
  if (!out.is_cdr()) out.Put(std::uint32_t{0});
  out.Put(std::uint32_t{1}).Put(std::uint32_t{2}).PutString("map");
  out.Put(std::uint32_t{1}).Put(std::uint32_t{5}).Put(std::uint32_t{6});
  out.Put(std::int32_t{-1}).Put(std::int32_t{7}).PutString("a").PutString("bc");
  out.Put(std::uint32_t{2});
  for (const double value : {0.5, -3.0}) out.Put(value).Put(std::uint8_t{9});
  if (out.is_cdr()) out.Put(std::uint8_t{0});  // What has no members has a byte in CDR.
  for (const std::uint16_t number : {1, 2, 3}) out.Put(number);
  out.Put(std::uint8_t{1});
  return out.Take();
}

TEST(MessageSchema, UnderstandsAllThatAnInterfaceMayHold) {
  const auto schema = MessageSchema::Parse("own/Odd", kOdd);
  ASSERT_TRUE(schema);
  const std::string ros1 = OddMessage(Encoding::kRos1), cdr = OddMessage(Encoding::kCdr);
  EXPECT_EQ(schema->Rewrite(ros1, Encoding::kRos1, Encoding::kCdr), cdr);
  EXPECT_EQ(schema->Rewrite(cdr, Encoding::kCdr, Encoding::kRos1), ros1);
}

TEST(MessageSchema, InterfacesThatAreNotWholeAreNone) {
  EXPECT_FALSE(MessageSchema::Parse("own/A", "B part\n"));
  EXPECT_FALSE(MessageSchema::Parse("own/A", "wstring text\n"));
  EXPECT_FALSE(MessageSchema::Parse("own/A", "uint8[x] data\n"));
  EXPECT_FALSE(MessageSchema::Parse("own/A", "nonsense\n"));
  // One that contains itself has no end.
  const auto endless = MessageSchema::Parse("own/A", "own/A a\n");
  EXPECT_TRUE(!endless || !endless->Rewrite("", Encoding::kRos1, Encoding::kCdr));
  const auto wide = MessageSchema::Parse(
      "own/A", "own/B[4000000000] parts\n====\nMSG: own/B\n====\nMSG: own/C\nint8 x\n");
  ASSERT_TRUE(wide);
  EXPECT_FALSE(wide->Rewrite("", Encoding::kRos1, Encoding::kCdr));
}

TEST(Ros2Definition, HasTimesAndHeadersOfRos2) {
  const std::string text = Ros2Definition(PoseStampedDescription().definition);
  EXPECT_THAT(text, ::testing::HasSubstr("MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\n"));
  EXPECT_THAT(text,
              ::testing::HasSubstr("MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("seq")));
  EXPECT_EQ(Ros2Definition(text), text);
  EXPECT_EQ(Ros2TypeName("livox_ros_driver/CustomMsg"), "livox_ros_driver2/msg/CustomMsg");
}

}  // namespace
}  // namespace trajlo
