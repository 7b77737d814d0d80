// SPDX-License-Identifier: MIT
// The point layouts of all drivers, serialised by a foreign tool in both encodings.
#include <gmock/gmock.h>

#include "core/io/messages/pose_decoder.h"
#include "tests/core/io/ros2/ros2_testing.h"

namespace trajlo {
namespace {

using ::testing::Contains;

constexpr std::int64_t kStampNs = 1'600'000'000'000'000'000;

/// The points that make_fixtures.py writes.
void ExpectPoints(const PointTable& table, std::size_t count) {
  ASSERT_EQ(table.count, count);
  const auto x = Values(table, "x");
  const auto y = Values(table, "y");
  const auto z = Values(table, "z");
  ASSERT_EQ(x.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(x[i], 0.25 * static_cast<double>(i) - 4.0) << i;
    EXPECT_EQ(y[i], 10.0 - 0.5 * static_cast<double>(i)) << i;
    EXPECT_EQ(z[i], 0.125 * static_cast<double>(i % 8)) << i;
  }
}

void ExpectColumn(const PointTable& table, const std::string& name, ScalarType type, double zero,
                  double slope) {
  const Column* column = table.Find(name);
  ASSERT_NE(column, nullptr) << name << " is not among " << table.FieldNames();
  EXPECT_EQ(column->type, type) << name;
  const auto values = Values(table, name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double wanted = zero + slope * static_cast<double>(i);
    EXPECT_EQ(values[i], type == ScalarType::kFloat32 ? static_cast<float>(wanted) : wanted)
        << name << " " << i;
  }
}

class Layouts : public ::testing::TestWithParam<const char*> {
 protected:
  bool IsRos1() const { return std::string(GetParam()) == "ros1.mcap"; }
};

TEST_P(Layouts, OfEveryDriverHaveTheirPointsAndTimes) {
  MessageReport report;
  auto clouds = ReadClouds(Fixture(GetParam()), &report);
  EXPECT_EQ(clouds.size(), IsRos1() ? 12U : 14U);
  for (const auto& [topic, messages] : clouds) {
    SCOPED_TRACE(topic);
    ExpectPoints(messages[0].table, topic == "/short_data" ? 7 : 12);
    EXPECT_EQ(messages[0].stamp_ns, kStampNs);
    EXPECT_EQ(messages[0].recorded_ns, kStampNs + 100'000'000);
    EXPECT_EQ(messages[0].frame_id,
              topic.find("livox") == 1 && topic != "/livox_cloud" ? "livox" : "lidar");
    EXPECT_EQ(messages[0].table.damage.empty(), topic != "/short_data");
  }
  EXPECT_EQ(clouds["/velodyne"].size(), 2U);
  EXPECT_EQ(clouds["/velodyne"][1].stamp_ns, kStampNs + 100'000'000);
  EXPECT_FALSE(report.damaged);

  const auto table = [&](const char* topic) -> const PointTable& { return clouds[topic][0].table; };
  ExpectColumn(table("/velodyne"), "time", ScalarType::kFloat32, 0.0, 0.0025);
  ExpectColumn(table("/velodyne_padded"), "time", ScalarType::kFloat32, 0.0, 0.0025);
  ExpectColumn(table("/ouster_old"), "t", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table("/ouster_new"), "t", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table("/ouster_new"), "range", ScalarType::kUint32, 0.0, 1000.0);
  ExpectColumn(table("/ouster_new"), "reflectivity", ScalarType::kUint16, 0.0, 1.0);
  ExpectColumn(table("/hesai"), "timestamp", ScalarType::kFloat64, 1.6e9, 0.0025);
  ExpectColumn(table("/robosense"), "timestamp", ScalarType::kFloat64, 1.6e9, 0.0025);
  ExpectColumn(table("/livox_cloud"), "timestamp", ScalarType::kFloat64, 1.6e18, 2.5e6);
  ExpectColumn(table("/padded_rows"), "t", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table("/big_endian_points"), "timestamp", ScalarType::kFloat64, 1.6e9, 0.0025);
  ExpectColumn(table("/livox"), "offset_time", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table("/livox"), "reflectivity", ScalarType::kUint8, 0.0, 1.0);
  ExpectColumn(table("/livox"), "tag", ScalarType::kUint8, 16.0, 0.0);
  if (IsRos1()) return;
  ExpectColumn(table("/big_endian_cdr"), "t", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table("/livox_big_endian_cdr"), "offset_time", ScalarType::kUint32, 0.0, 2.5e6);
}

TEST_P(Layouts, MayHoldEveryTypeUnalignedAndOutOfOrder) {
  auto clouds = ReadClouds(Fixture(GetParam()));
  const PointTable& table = clouds["/all_types"][0].table;
  EXPECT_EQ(table.Find("z")->type, ScalarType::kFloat64);
  ExpectColumn(table, "a", ScalarType::kInt8, 0.0, -1.0);
  ExpectColumn(table, "b", ScalarType::kUint8, 200.0, 1.0);
  ExpectColumn(table, "c", ScalarType::kInt16, 0.0, -1000.0);
  ExpectColumn(table, "d", ScalarType::kInt32, 0.0, -70000.0);
  ExpectColumn(table, "t", ScalarType::kUint32, 0.0, 2.5e6);
  ExpectColumn(table, "intensity", ScalarType::kFloat32, 0.0, 1.0);
  ExpectColumn(table, "normal", ScalarType::kFloat32, 0.0, 1.0);
  EXPECT_EQ(table.Find("ring")->type, ScalarType::kUint16);
}

TEST_P(Layouts, ShortDataGiveTheirWholePointsAndNumbersOfWhatIsMissing) {
  auto clouds = ReadClouds(Fixture(GetParam()));
  EXPECT_EQ(clouds["/short_data"][0].table.damage,
            "1 x 12 points of 20 bytes declared, 7 whole ones in the 145 bytes of data");
}

TEST_P(Layouts, PosesOfEveryTypeAreRead) {
  Rosbag2Reader reader(Fixture(GetParam()));
  std::map<std::string, StampedPose> poses;
  RawMessage raw;
  while (reader.Next(&raw)) {
    const Topic& topic = reader.topics()[raw.topic];
    if (!IsPoseType(topic.type)) continue;
    const auto pose = DecodePose(topic.type, topic.encoding, raw.bytes.view());
    ASSERT_TRUE(pose) << topic.name;
    poses.emplace(topic.name, *pose);
  }
  ASSERT_EQ(poses.size(), 5U);
  for (const auto& [topic, pose] : poses) {
    EXPECT_EQ(pose.t_ns, kStampNs) << topic;
    EXPECT_EQ(pose.T_world_body.t, Eigen::Vector3d(1.0, -2.0, 0.5)) << topic;
    const Eigen::Vector4d q = topic == "/point" ? Eigen::Vector4d(0.0, 0.0, 0.0, 1.0)
                                                : Eigen::Vector4d(0.0, 0.6, 0.0, 0.8);
    EXPECT_LT((pose.T_world_body.q.coeffs() - q).norm(), 1e-15) << topic;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Layouts,
                         ::testing::Values("none.mcap", "zstd.mcap", "lz4.mcap", "unchunked.mcap",
                                           "ros1.mcap"),
                         [](const auto& param) {
                           const std::string name = param.param;
                           return name.substr(0, name.find('.'));
                         });

TEST(Containers, HoldTheSameMessages) {
  const auto wanted = ReadAll(Fixture("none.mcap"));
  EXPECT_EQ(wanted.size(), 22U);
  for (const char* name : {"zstd.mcap", "lz4.mcap", "unchunked.mcap"}) {
    EXPECT_EQ(ReadAll(Fixture(name)), wanted) << name;
  }
  for (const char* name :
       {"plain_db3", "file_zstd_db3", "message_zstd_db3", "split_db3", "folder_mcap"}) {
    const auto messages = ReadAll(Fixture(name));
    EXPECT_EQ(messages.size(), std::string(name) == "folder_mcap" ? 4U : 7U) << name;
    for (const NamedMessage& message : messages) EXPECT_THAT(wanted, Contains(message)) << name;
  }
}

}  // namespace
}  // namespace trajlo
