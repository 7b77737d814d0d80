// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>

#include "core/io/conversion/extract_poses.h"
#include "core/io/conversion/message_copy.h"
#include "core/io/conversion/open_bag.h"
#include "core/io/conversion/pcd_folder_writer.h"
#include "core/io/conversion/scan_bag_writer.h"
#include "core/io/errors.h"
#include "core/io/recording/open_clouds.h"
#include "core/io/recording/open_recording.h"
#include "core/io/ros1/ros1_bag_reader.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kStartNs = 1'700'000'000'123'456'789;
constexpr std::int64_t kPeriodNs = 100'000'000;

/// A sweep whose times are odd to the nanosecond; its stamp marks the start or the end.
LidarScan Scan(int index, bool stamp_at_end) {
  LidarScan scan;
  const std::int64_t start_ns = kStartNs + index * kPeriodNs;
  scan.stamp_ns = start_ns + (stamp_at_end ? kPeriodNs : 0);
  for (int i = 0; i < 50; ++i) {
    const auto f = static_cast<float>(i);
    scan.points.push_back({{1.0F + 0.1F * f, -f, 0.3F * f}, f, start_ns + i * 1'999'999});
  }
  return scan;
}

void ExpectSamePoints(const LidarScan& found, const LidarScan& expected) {
  ASSERT_EQ(found.points.size(), expected.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i) {
    EXPECT_EQ(found.points[i].xyz_m, expected.points[i].xyz_m);
    EXPECT_EQ(found.points[i].intensity, expected.points[i].intensity);
    EXPECT_EQ(found.points[i].t_ns, expected.points[i].t_ns) << "point " << i;
  }
}

/// The scans of a recording, read as trajlo_run reads them.
std::vector<LidarScan> ReadBack(const std::filesystem::path& path) {
  const auto recording = OpenRecording({path.string()}, {});
  std::vector<LidarScan> scans;
  LidarScan scan;
  while (recording->Next(&scan)) scans.push_back(scan);
  return scans;
}

/// A bag of eight scans, and of poses in between.
void WriteBag(const std::filesystem::path& path, CloudLayout layout, bool stamp_at_end,
              const Ros1BagOptions& options = {}) {
  ScanBagWriter bag(path, options);
  for (int i = 0; i < 8; ++i) {
    const LidarScan scan = Scan(i, stamp_at_end);
    const std::int64_t start_ns = SweepStartOf(scan);
    bag.WriteScan(layout, "/points", "lidar", {start_ns, start_ns, SweepEndOf(scan)}, scan);
    bag.WritePose("/truth", start_ns + kPeriodNs,
                  {Eigen::Quaterniond::Identity(), {0.5 * i, 0.0, 1.0}});
  }
  bag.Close();
}

class Conversion : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(StampAtEnd, Conversion, ::testing::Bool());

TEST_P(Conversion, ThroughBagsOfOusterAndLivoxNoPointMovesInSpaceOrTime) {
  const TempFolder folder;
  for (const CloudLayout layout : {CloudLayout::kOuster, CloudLayout::kLivox}) {
    const auto path = folder / ("bag" + std::to_string(static_cast<int>(layout)) + ".bag");
    WriteBag(path, layout, GetParam());
    const std::vector<LidarScan> scans = ReadBack(path);
    ASSERT_EQ(scans.size(), 8u);
    for (int i = 0; i < 8; ++i) {
      ExpectSamePoints(scans[static_cast<std::size_t>(i)], Scan(i, GetParam()));
    }
  }
}

TEST_P(Conversion, ThroughVelodynesSecondsTimesAreGoodToFourNanoseconds) {
  const TempFolder folder;
  WriteBag(folder / "v.bag", CloudLayout::kVelodyne, GetParam());
  const std::vector<LidarScan> scans = ReadBack(folder / "v.bag");
  ASSERT_EQ(scans.size(), 8u);
  const LidarScan expected = Scan(7, GetParam());
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(scans[7].points[i].t_ns - expected.points[i].t_ns), 0.0, 4.0);
  }
}

TEST_P(Conversion, ThroughAFolderNoPointMovesInSpaceOrTime) {
  const TempFolder folder;
  PcdFolderWriter writer(folder.path());
  for (int i = 0; i < 8; ++i) writer.Write(Scan(i, GetParam()));
  writer.Close();
  const std::vector<LidarScan> scans = ReadBack(folder.path());
  ASSERT_EQ(scans.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    ExpectSamePoints(scans[static_cast<std::size_t>(i)], Scan(i, GetParam()));
  }
}

TEST(PcdFolderWriter, ScansWithoutTimesStayWithout) {
  const TempFolder folder;
  PcdFolderWriter writer(folder.path());
  for (int i = 0; i < 3; ++i) {
    LidarScan scan = Scan(i, false);
    scan.has_point_times = false;
    for (LidarPoint& point : scan.points) point.t_ns = scan.stamp_ns;
    writer.Write(scan);
  }
  writer.Close();
  const std::vector<LidarScan> scans = ReadBack(folder.path());
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_FALSE(scans[1].has_point_times);
  EXPECT_EQ(scans[1].stamp_ns, kStartNs + kPeriodNs);
}

std::vector<std::string> MessagesOf(const std::filesystem::path& path) {
  Ros1BagReader reader(path);
  std::vector<std::string> all;
  RawMessage message;
  while (reader.Next(&message)) {
    all.push_back(reader.topics()[message.topic].name + " " + std::to_string(message.recorded_ns) +
                  " " + std::string(message.bytes.view()));
  }
  return all;
}

/// In the order of their first messages.
std::vector<ros1::Connection> PublishersOf(const std::filesystem::path& path) {
  Ros1BagReader reader(path);
  std::vector<ros1::Connection> publishers;
  RawMessage message;
  while (reader.Next(&message)) {
    const bool known =
        std::any_of(publishers.begin(), publishers.end(),
                    [&](const ros1::Connection& one) { return one.id == reader.connection().id; });
    if (!known) publishers.push_back(reader.connection());
  }
  return publishers;
}

TEST(CopyBags, CopiesEveryByteAndTheDefinitions) {
  const TempFolder folder;
  WriteBag(folder / "a.bag", CloudLayout::kOuster, false);
  Ros1BagOptions lz4;
  lz4.compression = BagCompression::kLz4;
  EXPECT_EQ(CopyBags({folder / "a.bag"}, folder / "b.bag", {}, lz4).messages, 16u);
  EXPECT_EQ(MessagesOf(folder / "b.bag"), MessagesOf(folder / "a.bag"));
  const std::vector<ros1::Connection> publishers = PublishersOf(folder / "b.bag");
  ASSERT_EQ(publishers.size(), 2u);
  EXPECT_EQ(publishers[0].topic, "/points");
  EXPECT_EQ(publishers[0].type, "sensor_msgs/PointCloud2");
  EXPECT_EQ(publishers[0].fields().Find("md5sum"), DescriptionOf(CloudLayout::kOuster).md5sum);
  EXPECT_EQ(publishers[0].fields().Find("message_definition"),
            DescriptionOf(CloudLayout::kOuster).definition);
}

/// The fields of a connection of std_msgs/String.
std::string PublisherHeader(const std::string& callerid, const std::string& latching) {
  std::string header;
  for (const std::string& field :
       {std::string("type=std_msgs/String"), std::string("md5sum=992ce8a1687cec8c8bd883ec73ca41d1"),
        std::string("message_definition=string data\n"), "callerid=" + callerid,
        "latching=" + latching}) {
    const auto size = static_cast<char>(field.size());
    header += std::string{size, '\0', '\0', '\0'} + field;
  }
  return header;
}

TEST(CopyBags, PublishersKeepTheirNamesAndAreLatchedAsTheyWere) {
  const TempFolder folder;
  const std::string latched = PublisherHeader("/map_server", "1");
  const std::string plain = PublisherHeader("/talker", "0");
  Ros1BagWriter writer(folder / "a.bag");
  for (int i = 0; i < 4; ++i) {
    writer.Write(ros1::Connection{0, "/said", "std_msgs/String", i % 2 == 0 ? latched : plain}, i,
                 std::string(4, '\0'));
  }
  writer.Close();
  // Two bags, as a recorder splits them: the same publisher is one in the copy.
  std::filesystem::copy_file(folder / "a.bag", folder / "b.bag");
  EXPECT_EQ(CopyBags({folder / "a.bag", folder / "b.bag"}, folder / "c.bag", {}).messages, 8u);
  const std::vector<ros1::Connection> publishers = PublishersOf(folder / "c.bag");
  ASSERT_EQ(publishers.size(), 2u);
  EXPECT_EQ(publishers[0].header, latched);
  EXPECT_EQ(publishers[0].fields().Find("callerid"), "/map_server");
  EXPECT_EQ(publishers[0].fields().Find("latching"), "1");
  EXPECT_EQ(publishers[1].header, plain);
  // One topic all the same.
  EXPECT_EQ(Ros1BagReader(folder / "c.bag").topics().size(), 1u);
}

TEST(CopyBags, TakesATopicAndATime) {
  const TempFolder folder;
  WriteBag(folder / "a.bag", CloudLayout::kOuster, false);
  MessageCopyOptions options;
  options.topics = {"/truth"};
  options.start_ns = 2 * kPeriodNs;
  options.duration_ns = 3 * kPeriodNs;
  EXPECT_EQ(CopyBags({folder / "a.bag"}, folder / "b.bag", options).messages, 3u);
  options.topics = {"/nope"};
  try {
    CopyBags({folder / "a.bag"}, folder / "c.bag", options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/points (sensor_msgs/PointCloud2)"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "c.bag"));
}

TEST(CopyBags, MendsABagWithoutItsEnd) {
  const TempFolder folder;
  Ros1BagOptions small_chunks;
  small_chunks.chunk_bytes = 1000;
  WriteBag(folder / "whole.bag", CloudLayout::kOuster, false, small_chunks);
  const std::string bytes = ReadFile(folder / "whole.bag");
  WriteFile(folder / "cut.bag", bytes.substr(0, bytes.size() / 2));
  const MessageCopyResult copied = CopyBags({folder / "cut.bag"}, folder / "mended.bag", {});
  EXPECT_TRUE(copied.report.damaged);
  EXPECT_GT(copied.messages, 3u);
  Ros1BagReader mended(folder / "mended.bag");
  EXPECT_FALSE(mended.report().damaged);
  EXPECT_EQ(PublishersOf(folder / "mended.bag")[0].fields().Find("message_definition"),
            DescriptionOf(CloudLayout::kOuster).definition);
  std::vector<std::string> expected = MessagesOf(folder / "whole.bag");
  expected.resize(copied.messages);
  EXPECT_EQ(MessagesOf(folder / "mended.bag"), expected);
}

TEST(BagsOf, AFolderOfBothKindsIsReadWholeInTheOrderOfTheNames) {
  const TempFolder folder;
  WriteBag(folder / "whole.bag", CloudLayout::kOuster, false);
  const auto copy = [&](const std::filesystem::path& from, const std::string& to,
                        std::int64_t start_ns, std::int64_t duration_ns) {
    MessageCopyOptions part;
    part.start_ns = start_ns;
    part.duration_ns = duration_ns;
    const auto bag = OpenBag(folder / to);
    CopyMessages(from, part, bag.get());
    bag->Close();
  };
  std::filesystem::create_directories(folder / "parts");
  copy(folder / "whole.bag", "parts/a.bag", 0, 250'000'000);
  copy(folder / "whole.bag", "parts/b.mcap", 250'000'000, 200'000'000);
  copy(folder / "whole.bag", "parts/c.bag", 450'000'000, 0);
  EXPECT_THAT(Ros1BagsOf(folder / "parts"), ::testing::IsEmpty());
  EXPECT_EQ(ExtractPoses(folder / "parts", "/truth").poses.size(), 8u);
  copy(folder / "parts", "again.mcap", 0, 0);
  for (const char* name : {"parts", "again.mcap"}) {
    const std::vector<LidarScan> scans = ReadBack(folder / name);
    ASSERT_EQ(scans.size(), 8u) << name;
    for (int i = 0; i < 8; ++i)
      ExpectSamePoints(scans[static_cast<std::size_t>(i)], Scan(i, false));
  }
}

TEST(TopicOf, IsAsPublicRecordingsNameIt) {
  EXPECT_EQ(TopicOf(CloudLayout::kOuster, 1, 2), "/os1_cloud_node2/points");
  EXPECT_EQ(TopicOf(CloudLayout::kVelodyne, 0, 1), "/velodyne_points");
  EXPECT_EQ(TopicOf(CloudLayout::kLivox, 0, 1), "/livox/lidar");
}

}  // namespace
}  // namespace trajlo::testing
