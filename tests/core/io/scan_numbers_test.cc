// SPDX-License-Identifier: MIT
#include "core/io/scan_numbers.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(MissingScans, AreTheNumbersThatTheNamesLeaveOut) {
  const MissingScans missing =
      FindMissingScans({"a_08_b.pcd", "a_09_b.pcd", "a_12_b.pcd", "a_13_b.pcd", "a_15_b.pcd"});
  EXPECT_THAT(missing.before, ElementsAre(0, 0, 2, 2, 3));
  EXPECT_THAT(missing.finding,
              AllOf(HasSubstr("3 scans are missing, the first between a_09_b.pcd and a_12_b.pcd"),
                    HasSubstr("that much time is left out")));
}

TEST(MissingScans, AreCountedInTheUsualStep) {
  EXPECT_THAT(FindMissingScans({"0.bin", "5.bin", "10.bin", "20.bin"}).before,
              ElementsAre(0, 0, 0, 1));
  EXPECT_EQ(FindMissingScans({"0.bin", "5.bin", "10.bin"}).finding, "");
}

TEST(MissingScans, ANumberThatLeapsIsNoCount) {
  const MissingScans missing = FindMissingScans({"1.bin", "2.bin", "3.bin", "999000.bin"});
  EXPECT_THAT(missing.before, ElementsAre(0, 0, 0, 0));
  EXPECT_THAT(missing.finding,
              AllOf(HasSubstr("leaps between 3.bin and 999000.bin"), HasSubstr("no time")));
}

TEST(MissingScans, NamesThatAreNoCountSayNothing) {
  using Files = std::vector<std::filesystem::path>;
  for (const Files& files : {Files{"a.bin", "b.bin", "c.bin"}, Files{"1.bin", "b3.bin", "b5.bin"},
                             Files{"1000.bin", "1099.bin", "1201.bin", "1300.bin"},
                             Files{"1_1.bin", "1_2.bin", "1_4.bin"}, Files{"1.bin"}, Files{}}) {
    const MissingScans missing = FindMissingScans(files);
    EXPECT_EQ(missing.before.size(), files.size());
    EXPECT_EQ(missing.finding, "");
  }
}

}  // namespace
}  // namespace trajlo
