// SPDX-License-Identifier: MIT
// What is written is what is read.
#include "core/io/messages/message_writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/io/errors.h"
#include "core/io/messages/pose_decoder.h"
#include "core/io/scan_decoder.h"
#include "tests/core/io/messages/messages_testing.h"

namespace trajlo {
namespace {

constexpr std::int64_t kStartNs = 1'700'000'000'123'456'789;

std::uint32_t Bits(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

bool SameBits(float a, float b) { return Bits(a) == Bits(b); }

class Written : public ::testing::TestWithParam<CloudLayout> {};

TEST_P(Written, CloudsKeepPositionsAndIntensitiesToTheBitAndTimesToTheLayoutsLimit) {
  LidarScan scan = MakeScan(1000, kStartNs);
  scan.points[17].xyz_m.setConstant(std::numeric_limits<float>::quiet_NaN());
  scan.points[18].xyz_m.x() = -0.0F;
  const MessageHeader header{5, kStartNs, "lidar"};
  const CloudMessage cloud =
      Decoded(TypeOf(GetParam()), WriteCloud(GetParam(), header, kStartNs, scan));
  EXPECT_EQ(cloud.stamp_ns, kStartNs);
  EXPECT_EQ(cloud.frame_id, "lidar");
  EXPECT_EQ(cloud.table.damage, "");

  TimeConvention convention;
  convention.field = FindTimeColumn(cloud.table, "")->name;
  const bool is_velodyne = GetParam() == CloudLayout::kVelodyne;
  convention.unit = is_velodyne ? TimeUnit::kSeconds : TimeUnit::kNanoseconds;
  convention.sweep_ns = 100'000'000;
  LidarScan read;
  EXPECT_EQ(DecodeScan("bag", cloud.table, convention, cloud.stamp_ns, &read), 0U);
  ASSERT_EQ(read.points.size(), scan.points.size());
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(SameBits(read.points[i].xyz_m[axis], scan.points[i].xyz_m[axis])) << i;
    }
    ASSERT_TRUE(SameBits(read.points[i].intensity, scan.points[i].intensity)) << i;
    // A float32 below 0.1 s has steps of 7.5 ns.
    ASSERT_LE(std::abs(read.points[i].t_ns - scan.points[i].t_ns), is_velodyne ? 4 : 0) << i;
  }
}

TEST_P(Written, CloudsWithoutPointsAreRead) {
  const CloudMessage cloud =
      Decoded(TypeOf(GetParam()), WriteCloud(GetParam(), {0, kStartNs, ""}, kStartNs, LidarScan{}));
  EXPECT_EQ(cloud.table.count, 0U);
  EXPECT_NE(cloud.table.Find("x"), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Written,
                         ::testing::Values(CloudLayout::kOuster, CloudLayout::kVelodyne,
                                           CloudLayout::kLivox));

TEST(MessageWriter, ADriverMayStampTheEndOfTheSweep) {
  const LidarScan scan = MakeScan(10, kStartNs);
  const MessageHeader end{0, kStartNs + 100'000'000, "lidar"};
  const CloudMessage cloud =
      Decoded("sensor_msgs/PointCloud2", WriteCloud(CloudLayout::kOuster, end, kStartNs, scan));
  EXPECT_EQ(cloud.stamp_ns, end.stamp_ns);
  EXPECT_EQ(Values(cloud.table, "t").front(), 0.0);
  EXPECT_EQ(Values(cloud.table, "t").back(), 89'999'999.0);
}

TEST(MessageWriter, TimesThatDoNotFitAreErrors) {
  LidarScan scan = MakeScan(10, kStartNs);
  for (const CloudLayout layout : {CloudLayout::kOuster, CloudLayout::kLivox}) {
    EXPECT_THROW(WriteCloud(layout, {}, kStartNs + 1, scan), std::invalid_argument);
    EXPECT_THROW(WriteCloud(layout, {}, kStartNs - 5'000'000'000, scan), std::invalid_argument);
  }
  EXPECT_NO_THROW(WriteCloud(CloudLayout::kVelodyne, {}, kStartNs + 1, scan));
}

TEST(MessageWriter, ALivoxReflectivityIsRoundedAndClamped) {
  LidarScan scan = MakeScan(4, kStartNs);
  scan.points[0].intensity = -3.0F;
  scan.points[1].intensity = 0.6F;
  scan.points[2].intensity = 1e9F;
  scan.points[3].intensity = std::numeric_limits<float>::quiet_NaN();
  const CloudMessage cloud =
      Decoded(TypeOf(CloudLayout::kLivox),
              WriteCloud(CloudLayout::kLivox, {0, kStartNs, ""}, kStartNs, scan));
  EXPECT_EQ(Values(cloud.table, "reflectivity"), (std::vector<double>{0.0, 1.0, 255.0, 0.0}));
}

TEST(MessageWriter, StampsBefore1970AreReadAsTheyWereOrRefused) {
  const std::string type = PoseStampedDescription().type;
  for (const std::int64_t t_ns : {-1'500'000'000LL, -1LL, -2'000'000'000LL, 0LL, 1'999'999'999LL,
                                  -2'147'483'648'000'000'000LL, 2'147'483'647'999'999'999LL}) {
    const auto pose =
        DecodePose(type, Encoding::kCdr, WritePoseStamped({0, t_ns, "world"}, {}, Encoding::kCdr));
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->t_ns, t_ns);
  }
  for (const std::int64_t t_ns : {-2'147'483'648'000'000'001LL, 2'147'483'648'000'000'000LL}) {
    EXPECT_THROW(WritePoseStamped({0, t_ns, "world"}, {}, Encoding::kCdr), OutputError) << t_ns;
  }
  for (const std::int64_t t_ns : {-1LL, -1'500'000'000LL, 4'294'967'296'000'000'000LL}) {
    EXPECT_THROW(WritePoseStamped({0, t_ns, "world"}, {}, Encoding::kRos1), OutputError) << t_ns;
  }
  const auto last = DecodePose(type, Encoding::kRos1,
                               WritePoseStamped({0, 4'294'967'295'999'999'999, "world"}, {}));
  ASSERT_TRUE(last);
  EXPECT_EQ(last->t_ns, 4'294'967'295'999'999'999);
}

TEST(MessageWriter, PosesAreReadAsTheyWere) {
  const SE3 T(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), {1e6 + 0.1, -2.5, 1e-9});
  const auto pose = DecodePose(PoseStampedDescription().type, Encoding::kRos1,
                               WritePoseStamped({1, kStartNs, "world"}, T));
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->t_ns, kStartNs);
  EXPECT_EQ(pose->T_world_body.t, T.t);
  EXPECT_EQ(pose->T_world_body.q.coeffs(), T.q.coeffs());
}

}  // namespace
}  // namespace trajlo
