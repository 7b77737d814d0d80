// SPDX-License-Identifier: MIT
#include "core/io/stamp_of_name.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

TEST(StampOfName, SecondsWithDecimals) {
  EXPECT_EQ(StampOfName("9.500.pcd"), 9500000000);
  EXPECT_EQ(StampOfName("10.2251.pcd"), 10225100000);
  EXPECT_EQ(StampOfName("1583836591.182590976.pcd"), 1583836591182590976);
}

TEST(StampOfName, NanosecondsOrSecondsAndNanoseconds) {
  EXPECT_EQ(StampOfName("1583836591182590976.pcd"), 1583836591182590976);
  EXPECT_EQ(StampOfName("cloud_1583836592_82590976.pcd"), 1583836592082590976);
  EXPECT_EQ(StampOfName("9999999999_5.bin"), std::nullopt) << "the year 2286";
}

TEST(StampOfName, ADateAndATimeOfDay) {
  EXPECT_EQ(StampOfName("2020-03-10-12-30-59.950.pcd"), 1583843459950000000);
  EXPECT_EQ(StampOfName("20200310T123100.050.pcd"), 1583843460050000000);
  EXPECT_EQ(StampOfName("cloud_2020-03-10_12:31:00.15.pcd"), 1583843460150000000);
}

TEST(StampOfName, SecondsOfADayThatIsNotUnderstoodAreNone) {
  EXPECT_EQ(StampOfName("10Mar20-12-30-59.950.pcd"), std::nullopt);
}

TEST(StampOfName, IndicesAreNone) {
  EXPECT_EQ(StampOfName("0000000001.bin"), std::nullopt);
  EXPECT_EQ(StampOfName("scan_12.bin"), std::nullopt);
  EXPECT_EQ(StampOfName("map.pcd"), std::nullopt);
}

}  // namespace
}  // namespace trajlo
