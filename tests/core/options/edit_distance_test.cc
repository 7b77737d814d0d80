// SPDX-License-Identifier: MIT
#include "core/options/edit_distance.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

TEST(EditDistance, CountsLettersThatAreMissingWrongTooManyOrSwapped) {
  EXPECT_EQ(EditDistance("", ""), 0);
  EXPECT_EQ(EditDistance("", "abc"), 3);
  EXPECT_EQ(EditDistance("segments", "segments"), 0);
  EXPECT_EQ(EditDistance("segments", "segment"), 1);
  EXPECT_EQ(EditDistance("segmets", "segments"), 1);
  EXPECT_EQ(EditDistance("sekments", "segments"), 1);
  EXPECT_EQ(EditDistance("esgments", "segments"), 1);
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3);
  EXPECT_EQ(EditDistance("sitting", "kitten"), 3);
}

TEST(NearestKey, OfEquallyNearOnesIsTheFirst) {
  EXPECT_EQ(NearestKey("sise", {"a.size", "b.size", "b.sine"}), "a.size");
  EXPECT_EQ(NearestKey("sise", {"b.sine", "b.size", "a.size"}), "b.sine");
}

TEST(NearestKey, PrefersAWholeKeyToALastPartThatIsAsClose) {
  EXPECT_EQ(NearestKey("map.kinds", {"solver.kind", "map.kind"}), "map.kind");
  EXPECT_EQ(NearestKey("map.kinds", {"map.kind", "solver.kind"}), "map.kind");
}

TEST(NearestKey, IsNoneWhereNothingIsNear) {
  EXPECT_EQ(NearestKey("map.radius", {"solver.kind", "window.segments"}), "");
  // Two letters of a short word, a third of a long one.
  EXPECT_EQ(NearestKey("kxxd", {"kind"}), "kind");
  EXPECT_EQ(NearestKey("xxxd", {"kind"}), "");
  EXPECT_EQ(NearestKey("max_corxxxtion", {"max_correction"}), "max_correction");
}

TEST(NearestOrLonger, TakesABeginningForTheWhole) {
  const std::vector<std::string> names = {"hall_os1_16", "office_os0_64"};
  EXPECT_EQ(NearestOrLonger("hall", names), "hall_os1_16");
  EXPECT_EQ(NearestOrLonger("offcie_os", names), "office_os0_64");
  EXPECT_EQ(NearestKey("hall", names), "");
  EXPECT_EQ(NearestOrLonger("motion.sped", {"motion.kind", "motion.speed_mps"}),
            "motion.speed_mps");
  EXPECT_EQ(NearestOrLonger("motorway", names), "");
}

}  // namespace
}  // namespace trajlo
