// SPDX-License-Identifier: MIT
#include "core/report/rig_report.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LidarCorrection Moved(double x_m, double yaw_rad, double clock_s) {
  const Eigen::Quaterniond q(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return {{q, {x_m, 0, 0}}, clock_s};
}

TEST(RigReport, SaysHowFarLidarsAreFromWhereTheyWereSaidToBe) {
  const SE3 given = se3::Exp(0.5 * Vector6d::Ones());
  const LidarPlace reference = CorrectedPlace(0, given, 0.1, {}, RigEvidence::kConfirmed);
  const LidarPlace place =
      CorrectedPlace(1, SE3(), 0.1, Moved(0.012, 0.01, -0.0048), RigEvidence::kConfirmed);
  EXPECT_NEAR(place.moved_m, 0.012, 1e-12);
  EXPECT_NEAR(place.turned_rad, 0.01, 1e-12);
  EXPECT_NEAR(place.clock_offset_s, 0.0952, 1e-12);
  EXPECT_EQ(place.T_body_lidar.t.x(), 0.012);
  EXPECT_EQ(CorrectionsText({reference, place}), "LiDAR 1 by 0.012 m, 0.57 degrees and -4.8 ms");
  EXPECT_EQ(CorrectionsText(
                {reference, place,
                 CorrectedPlace(2, SE3(), 0.0, Moved(0.1, 0.0, 0.0), RigEvidence::kConfirmed)}),
            "LiDAR 1 by 0.012 m, 0.57 degrees and -4.8 ms, LiDAR 2 by 0.100 m, 0.00 degrees and "
            "0.0 ms");
}

/// A turn about the body moves a LiDAR that sits a metre away.
TEST(RigReport, ATurnMovesALidar) {
  const SE3 given(Eigen::Quaterniond::Identity(), {0, 1, 0});
  EXPECT_NEAR(CorrectedPlace(1, given, 0.0, Moved(0.0, 0.01, 0.0), RigEvidence::kConfirmed).moved_m,
              0.01, 1e-6);
}

TEST(RigReport, SaysNothingOfLidarsThatAreNotKnown) {
  EXPECT_EQ(
      CorrectionsText({CorrectedPlace(1, SE3(), 0.0, Moved(0.01, 0.0, 0.0), RigEvidence::kNotYet)}),
      "");
}

TEST(RigReport, WarnsOfLidarsThatAreFarOff) {
  const auto warnings = [](double x_m, double yaw_rad, double clock_s) {
    return RigWarnings(
        {CorrectedPlace(1, SE3(), 0.0, Moved(x_m, yaw_rad, clock_s), RigEvidence::kConfirmed)});
  };
  EXPECT_THAT(warnings(0.05, 0.03, 0.01), IsEmpty());
  EXPECT_THAT(warnings(0.1, 0.0, 0.0), ElementsAre(HasSubstr("is 0.100 m")));
  EXPECT_THAT(warnings(0.0, 0.07, 0.0), ElementsAre(HasSubstr("4.01 degrees")));
  EXPECT_THAT(warnings(0.0, 0.0, -0.04), ElementsAre(HasSubstr("-40.0 ms")));
}

TEST(RigReport, WarnsOfLeverArmsThatMayBeMillimetres) {
  const auto warnings = [](double x) {
    const SE3 given(Eigen::Quaterniond::Identity(), {x, 0, 0.05});
    return RigWarnings({CorrectedPlace(0, given, 0.0, {}, RigEvidence::kConfirmed)});
  };
  EXPECT_THAT(warnings(5.0), IsEmpty());
  EXPECT_THAT(warnings(-50.0), ElementsAre(::testing::AllOf(HasSubstr("sits 50 m"),
                                                            HasSubstr("may be millimetres"))));
}

TEST(RigReport, WarnsOfLidarsThatNothingConfirms) {
  const auto warnings = [](RigEvidence evidence) {
    return RigWarnings({CorrectedPlace(1, SE3(), 0.0, Moved(0.5, 0.0, 0.0), evidence)});
  };
  EXPECT_THAT(warnings(RigEvidence::kContradicted), ElementsAre(HasSubstr("out of the map")));
  EXPECT_THAT(warnings(RigEvidence::kNone), ElementsAre(HasSubstr("nothing confirms")));
  // Where no map began, there was nothing to confirm it.
  EXPECT_THAT(warnings(RigEvidence::kNotYet), ElementsAre(HasSubstr("0.500 m")));
  const LidarPlace reference = CorrectedPlace(0, SE3(), 0.0, {}, RigEvidence::kConfirmed);
  const LidarPlace unseen = CorrectedPlace(1, SE3(), 0.0, {}, RigEvidence::kNotYet);
  EXPECT_THAT(RigWarnings({reference, unseen}), ElementsAre(HasSubstr("from enough places")));
}

}  // namespace
}  // namespace trajlo
