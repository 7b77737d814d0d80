// SPDX-License-Identifier: MIT
#include "core/report/rig_report.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

SE3 Moved(double x_m, double yaw_rad) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), {x_m, 0, 0}};
}

TEST(RigReport, SaysHowFarLidarsAreFromWhereTheyWereSaidToBe) {
  const SE3 given = Moved(0.5, 1.0);
  const LidarPlace place = ComparePlaces(1, given, Moved(0.512, 1.01), true);
  EXPECT_NEAR(place.moved_m, 0.012, 1e-12);
  EXPECT_NEAR(place.turned_rad, 0.01, 1e-12);
  const LidarPlace reference = ComparePlaces(0, given, given, true);
  EXPECT_EQ(CorrectionsText({reference, place}), "LiDAR 1 by 0.012 m and 0.57 degrees");
  EXPECT_EQ(CorrectionsText({reference, place, ComparePlaces(2, given, Moved(0.6, 1.0), true)}),
            "LiDAR 1 by 0.012 m and 0.57 degrees, LiDAR 2 by 0.100 m and 0.00 degrees");
}

TEST(RigReport, SaysNothingOfLidarsThatAreNotKnown) {
  const LidarPlace unknown = ComparePlaces(1, SE3(), Moved(0.01, 0.0), false);
  EXPECT_EQ(CorrectionsText({unknown}), "");
}

TEST(RigReport, WarnsOfLidarsThatAreFarOff) {
  const auto warnings = [](double x_m, double yaw_rad) {
    return RigWarnings({ComparePlaces(1, SE3(), Moved(x_m, yaw_rad), true)});
  };
  EXPECT_THAT(warnings(0.05, 0.03), IsEmpty());
  EXPECT_THAT(warnings(0.1, 0.0), ElementsAre(HasSubstr("LiDAR 1 seems to be 0.100 m")));
  EXPECT_THAT(warnings(0.0, 0.07), ElementsAre(HasSubstr("4.01 degrees")));
}

}  // namespace
}  // namespace trajlo
