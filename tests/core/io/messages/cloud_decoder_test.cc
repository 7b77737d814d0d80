// SPDX-License-Identifier: MIT
// Messages that contradict themselves, are cut, or have two clocks.
#include "core/io/messages/cloud_decoder.h"

#include <gmock/gmock.h>

#include <random>

#include "tests/core/io/messages/messages_testing.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kStartNs = 1'600'000'000'000'000'000;
constexpr char kCloud2[] = "sensor_msgs/PointCloud2";

template <typename T>
void Append(std::string* out, T value) {
  out->append(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// A PointCloud2 with a field x and whatever sizes one likes.
struct Cloud2 {
  std::uint32_t height = 1, width = 4, point_step = 8, row_step = 32, offset = 0;
  std::uint8_t datatype = 7;
  std::uint32_t count = 1, data_size = 32;
  std::string data = std::string(32, '\0');

  std::string Bytes() const {
    std::string out(12, '\0');
    Append(&out, std::uint32_t{0});
    Append(&out, height);
    Append(&out, width);
    Append(&out, std::uint32_t{1});
    Append(&out, std::uint32_t{1});
    out += 'x';
    Append(&out, offset);
    Append(&out, datatype);
    Append(&out, count);
    Append(&out, std::uint8_t{0});
    Append(&out, point_step);
    Append(&out, row_step);
    Append(&out, data_size);
    return out + data + '\1';
  }
};

TEST(CloudDecoder, KnowsTheTypesOfClouds) {
  EXPECT_TRUE(IsCloudType(kCloud2));
  EXPECT_TRUE(IsCloudType("livox_ros_driver/CustomMsg"));
  EXPECT_TRUE(IsCloudType("livox_ros_driver2/CustomMsg"));
  EXPECT_FALSE(IsCloudType("sensor_msgs/Imu"));
  EXPECT_FALSE(IsCloudType("sensor_msgs/PointCloud2 (json)"));
}

TEST(CloudDecoder, MovesTheMessageInsteadOfCopyingItsPoints) {
  RawMessage raw;
  raw.topic = 3;
  raw.recorded_ns = 9;
  raw.bytes = ToFileBytes(
      WriteCloud(CloudLayout::kOuster, {0, kStartNs, "l"}, kStartNs, MakeScan(9, kStartNs)));
  const char* before = raw.bytes.data();
  CloudMessage cloud;
  std::string remark;
  ASSERT_TRUE(DecodeCloud({"/c", kCloud2, Encoding::kRos1, 0}, &raw, &cloud, &remark));
  EXPECT_EQ(cloud.table.bytes.data(), before);
  EXPECT_EQ(cloud.topic, 3U);
  EXPECT_EQ(cloud.recorded_ns, 9);
}

TEST(CloudDecoder, DeclaredSizesAreNotBelieved) {
  const auto count = [](const Cloud2& cloud2) {
    CloudMessage cloud;
    std::string remark;
    EXPECT_TRUE(Decode(kCloud2, cloud2.Bytes(), &cloud, &remark)) << remark;
    Values(cloud.table, "x");
    EXPECT_NE(cloud.table.damage, "");
    return cloud.table.count;
  };
  Cloud2 huge;
  huge.width = huge.height = 0xFFFFFFFF;
  EXPECT_EQ(count(huge), 4U);
  huge.point_step = huge.row_step = 0xFFFFFFFF;
  EXPECT_EQ(count(huge), 0U);
  Cloud2 long_rows;
  long_rows.height = 3;
  long_rows.row_step = 0xFFFFFFFF;
  EXPECT_EQ(count(long_rows), 4U);
  Cloud2 cut;
  cut.data_size = 0xFFFFFFFF;
  cut.data.resize(23);
  cut.width = 9;
  EXPECT_EQ(count(cut), 3U);  // 23 bytes and the one of is_dense.
}

TEST(CloudDecoder, ARowStepThatContradictsTheDataIsIgnored) {
  Cloud2 cloud2;
  cloud2.height = 2;
  cloud2.width = 2;
  cloud2.row_step = 32;  // The size of all data, as some drivers write.
  const CloudMessage cloud = Decoded(kCloud2, cloud2.Bytes());
  EXPECT_EQ(cloud.table.count, 4U);
  EXPECT_EQ(cloud.table.damage, "");
}

TEST(CloudDecoder, PaddingBehindTheLastRowMayBeMissing) {
  Cloud2 cloud2;
  cloud2.height = 2;
  cloud2.width = 2;
  cloud2.row_step = 24;
  cloud2.data_size = 40;
  cloud2.data.assign(40, '\0');
  for (std::size_t i = 0; i < 4; ++i) {
    const float x = static_cast<float>(i);
    std::memcpy(&cloud2.data[i / 2 * 24 + i % 2 * 8], &x, sizeof(x));
  }
  const CloudMessage cloud = Decoded(kCloud2, cloud2.Bytes());
  EXPECT_EQ(Values(cloud.table, "x"), (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
}

TEST(CloudDecoder, DataThatHoldMorePointsThanAreDeclaredAreRemarked) {
  const auto remark_of = [](const Cloud2& cloud2, std::size_t undeclared) {
    CloudMessage cloud;
    std::string remark;
    EXPECT_TRUE(Decode(kCloud2, cloud2.Bytes(), &cloud, &remark)) << remark;
    EXPECT_EQ(cloud.table.undeclared, undeclared);
    return remark;
  };
  Cloud2 half;
  half.width = 2;
  EXPECT_THAT(remark_of(half, 2), HasSubstr("1 x 2 points of 8 bytes are declared, and the 32 "
                                            "bytes of data hold 4"));
  Cloud2 half_of_each_row;
  half_of_each_row.height = 2;
  half_of_each_row.width = 20;
  half_of_each_row.row_step = 40 * 8;
  half_of_each_row.data = std::string(2 * 40 * 8, '\0');
  half_of_each_row.data_size = 2 * 40 * 8;
  EXPECT_THAT(remark_of(half_of_each_row, 40), HasSubstr("hold 80"));
  Cloud2 padded = half_of_each_row;  // Rows of 64 bytes.
  padded.width = 36;
  EXPECT_EQ(remark_of(padded, 0), "");
}

TEST(CloudDecoder, FieldsThatCannotBeReadAreIgnoredWithARemark) {
  const auto remark = [](const Cloud2& cloud2) {
    CloudMessage cloud;
    std::string text;
    EXPECT_TRUE(Decode(kCloud2, cloud2.Bytes(), &cloud, &text));
    EXPECT_EQ(cloud.table.columns.size(), text.empty() ? 1U : 0U);
    return text;
  };
  Cloud2 outside;
  outside.offset = 5;
  EXPECT_EQ(remark(outside), "field 'x' is ignored: it begins at byte 5 of points of 8 bytes");
  outside.offset = 0xFFFFFFFF;
  EXPECT_NE(remark(outside), "");
  Cloud2 unknown;
  unknown.datatype = 42;
  EXPECT_EQ(remark(unknown), "field 'x' is ignored: its type 42 is unknown");
  Cloud2 no_count;  // As old drivers leave it.
  no_count.count = 0;
  EXPECT_EQ(remark(no_count), "");
}

TEST(CloudDecoder, PointsOfNoBytesAndMessagesWithoutPointsAreRejected) {
  Cloud2 cloud2;
  cloud2.point_step = 0;
  CloudMessage cloud;
  std::string remark;
  EXPECT_FALSE(Decode(kCloud2, cloud2.Bytes(), &cloud, &remark));
  EXPECT_THAT(remark, HasSubstr("points of no bytes"));
  EXPECT_FALSE(Decode(kCloud2, cloud2.Bytes().substr(0, 30), &cloud, &remark));
  EXPECT_THAT(remark, HasSubstr("30 bytes that ends before its points begin"));
  EXPECT_FALSE(Decode("livox_ros_driver/CustomMsg", "short", &cloud, &remark));
  EXPECT_FALSE(Decode("sensor_msgs/Imu", cloud2.Bytes(), &cloud, &remark));
  EXPECT_THAT(remark, HasSubstr("not a point cloud"));
}

std::int64_t LivoxStamp(std::int64_t header_ns, std::int64_t timebase_ns, std::string* remark) {
  const LidarScan scan = MakeScan(3, timebase_ns);
  CloudMessage cloud;
  EXPECT_TRUE(Decode(TypeOf(CloudLayout::kLivox),
                     WriteCloud(CloudLayout::kLivox, {0, header_ns, ""}, timebase_ns, scan), &cloud,
                     remark));
  return *cloud.stamp_ns;
}

TEST(LivoxClocks, TheTimebaseHasTheDigitsThatTheHeaderLost) {
  std::string remark;
  EXPECT_EQ(LivoxStamp(kStartNs + 119, kStartNs, &remark), kStartNs);
  EXPECT_EQ(remark, "");
}

TEST(LivoxClocks, AHeaderStampedWhenPublishedDoesNotMoveThePoints) {
  std::string remark;
  EXPECT_EQ(LivoxStamp(kStartNs + 103'000'000, kStartNs, &remark), kStartNs);
  EXPECT_THAT(remark, HasSubstr("0.103000 s after the timebase"));
}

TEST(LivoxClocks, AnotherClockInTheTimebaseYieldsToTheHeader) {
  std::string remark;
  EXPECT_EQ(LivoxStamp(kStartNs, 77'000'000'000, &remark), kStartNs);
  EXPECT_THAT(remark, HasSubstr("different clocks"));
}

TEST(LivoxClocks, OneThatIsNotSetIsNotUsed) {
  std::string remark;
  EXPECT_EQ(LivoxStamp(kStartNs, 0, &remark), kStartNs);
  EXPECT_EQ(LivoxStamp(0, kStartNs, &remark), kStartNs);
  EXPECT_EQ(remark, "");
}

TEST(CloudDecoder, CutAndFlippedMessagesNeitherCrashNorGiveMorePoints) {
  std::mt19937 random(3);
  const LidarScan scan = MakeScan(20, kStartNs);
  for (const CloudLayout layout :
       {CloudLayout::kOuster, CloudLayout::kVelodyne, CloudLayout::kLivox}) {
    const std::string whole = WriteCloud(layout, {0, kStartNs, "lidar"}, kStartNs, scan);
    const auto try_to_read = [&](const std::string& bytes, Encoding encoding) {
      RawMessage raw;
      raw.bytes = ToFileBytes(bytes);
      CloudMessage cloud;
      std::string remark;
      if (!DecodeCloud({"/c", TypeOf(layout), encoding, 0}, &raw, &cloud, &remark)) {
        EXPECT_NE(remark, "");
        EXPECT_EQ(raw.bytes.size(), bytes.size());
        return std::size_t{0};
      }
      for (const Column& column : cloud.table.columns) Values(cloud.table, column.name);
      return cloud.table.count;
    };
    std::size_t previous = 0;
    for (std::size_t size = 0; size <= whole.size(); ++size) {
      const std::size_t count = try_to_read(whole.substr(0, size), Encoding::kRos1);
      ASSERT_GE(count, previous);
      previous = count;
      try_to_read(std::string("\0\1\0\0", 4) + whole.substr(0, size), Encoding::kCdr);
    }
    EXPECT_EQ(previous, 20U);
    for (int trial = 0; trial < 2000; ++trial) {
      std::string broken = whole;
      for (int flips = 0; flips < 3; ++flips) {
        broken[random() % 250 % broken.size()] ^= static_cast<char>(1U << random() % 8);
      }
      try_to_read(broken, Encoding::kRos1);
    }
  }
}

}  // namespace
}  // namespace trajlo
