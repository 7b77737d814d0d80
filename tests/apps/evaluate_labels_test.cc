// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <limits>

#include "apps/evaluate/flag_values.h"
#include "apps/evaluate/labels.h"
#include "apps/evaluate/metric_columns.h"

namespace trajlo {
namespace {

using testing::ElementsAre;

TEST(Labels, AreTheNamesOfTheFilesIfTheseDiffer) {
  EXPECT_THAT(Labels({"x/a.tum", "x/b.tum"}), ElementsAre("a", "b"));
  EXPECT_THAT(Labels({"x/a.tum"}), ElementsAre("a"));
}

TEST(Labels, AreWhatDiffersOfThePathsElse) {
  EXPECT_THAT(Labels({"runs/a/result/trajectory.tum", "runs/b/result/trajectory.tum"}),
              ElementsAre("a", "b"));
  EXPECT_THAT(Labels({"r/trajectory.tum", "r/old/trajectory.tum"}), ElementsAre("r", "r/old"));
  EXPECT_THAT(Labels({"a.tum", "a.tum"}), ElementsAre("a", "a 2"));
}

TEST(Labels, BecomeFileNames) {
  EXPECT_THAT(FileNames({"a/b c", "a_b_c", "../x", "größe"}),
              ElementsAre("a_b_c", "a_b_c_2", ".._x", "größe"));
}

TEST(FormatValue, NamesWhatIsNoNumber) {
  EXPECT_EQ(FormatValue(0.0234, 3), "0.023");
  EXPECT_EQ(FormatValue(std::nullopt, 3), "");
  EXPECT_EQ(FormatValue(std::numeric_limits<double>::infinity(), 3), "inf");
  EXPECT_EQ(FormatValue(-std::numeric_limits<double>::infinity(), 3), "-inf");
  EXPECT_EQ(FormatValue(std::numeric_limits<double>::quiet_NaN(), 3), "-");
}

TEST(FlagValues, PiecesHaveAUnit) {
  const std::vector<RelativeErrorOptions> pieces = ParsePieces("1m,2.5s,10f,5d");
  ASSERT_EQ(pieces.size(), 4u);
  EXPECT_EQ(pieces[1].delta, 2.5);
  EXPECT_EQ(pieces[1].unit, DeltaUnit::kSeconds);
  EXPECT_EQ(pieces[2].unit, DeltaUnit::kFrames);
  EXPECT_TRUE(ParsePieces("").empty());
}

TEST(FlagValues, PosesAreVectorsAndQuaternionsOrMatrices) {
  const Eigen::Affine3d a = ParsePose("1,2,3,0,0,0.70710678,0.70710678");
  const Eigen::Affine3d b = ParsePose("0 -1 0 1  1 0 0 2  0 0 1 3");
  EXPECT_TRUE(a.isApprox(b, 1e-7));
}

TEST(FlagValues, RepeatedStampsFollowTheAssociation) {
  EXPECT_EQ(ParseRepeatedStamps("auto", AssociationRule::kNearest), RepeatedStamps::kAll);
  EXPECT_EQ(ParseRepeatedStamps("auto", AssociationRule::kOneToOne), RepeatedStamps::kLast);
  EXPECT_EQ(ParseRepeatedStamps("auto", AssociationRule::kInterpolate), RepeatedStamps::kFirst);
  EXPECT_EQ(ParseRepeatedStamps("last", AssociationRule::kNearest), RepeatedStamps::kLast);
}

}  // namespace
}  // namespace trajlo
