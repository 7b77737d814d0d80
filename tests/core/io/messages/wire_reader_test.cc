// SPDX-License-Identifier: MIT
#include "core/io/messages/wire_reader.h"

#include <gtest/gtest.h>

#include "core/io/messages/pose_decoder.h"

namespace trajlo {
namespace {

std::string_view Bytes(const char* text, std::size_t size) { return {text, size}; }

TEST(WireReader, Ros1IsPackedAndLittleEndian) {
  WireReader reader(Bytes("\1\2\0\0\0\3\0\0\0abc", 12), Encoding::kRos1);
  EXPECT_EQ(reader.Read<std::uint8_t>(), 1);
  EXPECT_EQ(reader.Read<std::uint32_t>(), 2U);
  EXPECT_EQ(reader.ReadString(), "abc");
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.remaining(), 0U);
}

TEST(WireReader, CdrAlignsNumbersToTheirSizeBehindItsHeader) {
  // Behind the header: a byte, three of padding, an integer, a string with NUL, a double at 16.
  const char raw[] =
      "\0\1\0\0"
      "\7xxx\5\0\0\0"
      "\2\0\0\0a\0xx"
      "\0\0\0\0\0\0\xF0\x3F";
  WireReader reader(Bytes(raw, 28), Encoding::kCdr);
  EXPECT_EQ(reader.Read<std::uint8_t>(), 7);
  EXPECT_EQ(reader.Read<std::uint32_t>(), 5U);
  EXPECT_EQ(reader.ReadString(), "a");
  EXPECT_EQ(reader.Read<double>(), 1.0);
  EXPECT_TRUE(reader.ok());
}

TEST(WireReader, CdrNamesItsByteOrder) {
  WireReader big(Bytes("\0\0\0\0\0\0\1\2", 8), Encoding::kCdr);
  EXPECT_TRUE(big.swap_bytes());
  EXPECT_EQ(big.Read<std::uint32_t>(), 258U);
  EXPECT_FALSE(WireReader(Bytes("\0\3\0\0\0\0\1\2", 8), Encoding::kCdr).ok());
  EXPECT_FALSE(WireReader(Bytes("\0\1\0", 3), Encoding::kCdr).ok());
}

TEST(WireReader, GivesNothingBeyondTheEndAndStaysThatWay) {
  WireReader reader(Bytes("\xFF\xFF\xFF\xFF\1\2\3", 7), Encoding::kRos1);
  EXPECT_EQ(reader.ReadString(), "");
  EXPECT_FALSE(reader.ok());
  EXPECT_EQ(reader.Read<std::uint8_t>(), 0);
  EXPECT_EQ(reader.remaining(), 0U);
  EXPECT_EQ(reader.ReadBytes(0), "");
}

TEST(PoseDecoder, RejectsWhatIsNoPoseAndTakesAZeroQuaternionForNoRotation) {
  const std::string header(16, '\0');
  const auto pose = [&](double x, double qw, std::size_t cut) {
    const double numbers[7] = {x, 0.0, 0.0, 0.0, 0.0, 0.0, qw};
    std::string bytes = header + std::string(reinterpret_cast<const char*>(numbers), 56);
    bytes.resize(bytes.size() - cut);
    return DecodePose("geometry_msgs/PoseStamped", Encoding::kRos1, bytes);
  };
  ASSERT_TRUE(pose(1.0, 2.0, 0));
  EXPECT_EQ(pose(1.0, 2.0, 0)->T_world_body.q.w(), 1.0);
  EXPECT_EQ(pose(1.0, 0.0, 0)->T_world_body.q.w(), 1.0);
  EXPECT_FALSE(pose(std::numeric_limits<double>::quiet_NaN(), 1.0, 0));
  EXPECT_FALSE(pose(1.0, std::numeric_limits<double>::infinity(), 0));
  // Its length is infinite; found by fuzzing, normalised to a quaternion of zeros.
  EXPECT_FALSE(pose(1.0, 1e200, 0));
  EXPECT_TRUE(pose(1e200, 1.0, 0));  // One that has flown off.
  EXPECT_FALSE(pose(1.0, 1.0, 1));
  EXPECT_FALSE(DecodePose("sensor_msgs/Imu", Encoding::kRos1, header));
}

}  // namespace
}  // namespace trajlo
