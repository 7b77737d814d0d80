// SPDX-License-Identifier: MIT
#include "core/io/inspection/findings.h"

#include <gmock/gmock.h>

#include "tests/core/io/inspection/inspection_testing.h"

namespace trajlo {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using trajlo::testing::Cloud;

TEST(FindingsOf, AGoodRecordingHasNone) { EXPECT_THAT(FindingsOf(Cloud("/a", {})), IsEmpty()); }

TEST(FindingsOf, NamesWhatGoesWrong) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.time_problem = "ambiguous point times";
  cloud.sweeps = SweepSummary{0.1, -0.05, 0.0, -0.1, 3};
  cloud.stamps.gaps = {{1'000'000'000, 400'000'000}, {2'000'000'000, 300'000'000}};
  cloud.stamps.missing = 5;
  cloud.stamps.duplicates = 2;
  cloud.stamps.first_duplicate_ns = 3'500'000'000;
  cloud.points.not_finite = 99'999;
  const std::vector<std::string> findings = FindingsOf(cloud);
  EXPECT_THAT(findings, Contains(HasSubstr("will refuse: ambiguous point times")));
  EXPECT_THAT(findings, Contains(HasSubstr("sweeps overlap by 0.05 s")));
  EXPECT_THAT(findings, Contains(HasSubstr("dropped: 3 points with impossible times")));
  EXPECT_THAT(findings, Contains(HasSubstr("2 gaps, about 5 scans are missing; the longest, 0.4 "
                                           "s, is after 1.000000000 s")));
  EXPECT_THAT(findings, Contains(HasSubstr("2 stamps repeat the one before, the first at 3.5")));
  EXPECT_THAT(findings, Contains(HasSubstr("only 0 returns a message")));
}

TEST(FindingsOf, CloudsThatAreRegisteredAlreadyAreNamed) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.frame_ids = {"camera_init"};
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("in frame 'camera_init'")));
}

TEST(FindingsOf, CoordinatesThatMayBeMillimetresAreNamed) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.points.range_median_m = 5000.0;
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("may be in millimetres")));
}

TEST(FindingsOf, StampsThatMayBeInAnotherUnitAreNamed) {
  CloudInspection cloud = Cloud("/a", {});
  cloud.stamps.period_s = 100.0;
  EXPECT_THAT(FindingsOf(cloud), Contains(HasSubstr("stamps are 100 s apart: they may be in ms, "
                                                    "and must then be written in s")));
}

}  // namespace
}  // namespace trajlo
