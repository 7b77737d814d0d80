// SPDX-License-Identifier: MIT
// ROS's own library as the judge: it reads what we read, and what we write.
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <algorithm>

#include "core/io/ros1/ros1_bag_writer.h"
#include "tests/core/io/ros1/ros1_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

std::vector<BagMessage> ReadByLibrosbag(const std::filesystem::path& path) {
  rosbag::Bag bag(path.string());
  rosbag::View view(bag);
  std::vector<BagMessage> all;
  for (const rosbag::MessageInstance& message : view) {
    std::string bytes(message.size(), '\0');
    ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                       message.size());
    message.write(stream);
    all.push_back(
        {message.getTopic(), static_cast<std::int64_t>(message.getTime().toNSec()), bytes});
  }
  return all;
}

/// Messages of the same stamp have no order.
void SortByStampAndTopic(std::vector<BagMessage>* messages) {
  std::sort(messages->begin(), messages->end(), [](const BagMessage& a, const BagMessage& b) {
    return std::tie(a.recorded_ns, a.topic) < std::tie(b.recorded_ns, b.topic);
  });
}

TEST(Librosbag, ReadsFromFixturesWhatWeRead) {
  // lz4.bag is missing here: its writer links blocks, which librosbag refuses.
  for (const char* name : {"none.bag", "bz2.bag"}) {
    EXPECT_EQ(ReadByLibrosbag(Fixture(name)), ReadBag(Fixture(name))) << name;
  }
}

TEST(Librosbag, ReadsFromRecordingsWhatWeRead) {
  for (const char* name : {"corridor_vlp16.bag", "square_os1_16x2.bag", "swing_avia.bag"}) {
    const auto path = SimulatedDir() / name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    std::vector<BagMessage> ours = ReadBag(path);
    std::vector<BagMessage> theirs = ReadByLibrosbag(path);
    SortByStampAndTopic(&ours);
    SortByStampAndTopic(&theirs);
    EXPECT_TRUE(ours == theirs) << name;
  }
}

TEST(Librosbag, ReadsWhatWeWrite) {
  const TempFolder folder;
  const MessageDescription type{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1",
                                "string data\n"};
  for (const auto compression :
       {BagCompression::kNone, BagCompression::kBz2, BagCompression::kLz4}) {
    for (const std::size_t chunk_bytes : {2500U, 768U * 1024U}) {
      Ros1BagOptions options;
      options.compression = compression;
      options.chunk_bytes = chunk_bytes;
      options.if_exists = IfExists::kReplace;
      Ros1BagWriter writer(folder / "a.bag", options);
      std::vector<BagMessage> messages = FixtureMessages();
      messages[30].bytes.assign(3'000'000, 'x');  // Several blocks of lz4.
      for (const BagMessage& message : messages) {
        writer.Write({message.topic, type}, message.recorded_ns, message.bytes);
      }
      writer.Close();
      EXPECT_TRUE(ReadByLibrosbag(folder / "a.bag") == messages);
    }
  }
}

}  // namespace
}  // namespace trajlo::testing
