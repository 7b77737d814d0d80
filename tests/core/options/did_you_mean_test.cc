// SPDX-License-Identifier: MIT
#include "core/options/did_you_mean.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

TEST(DidYouMean, NamesTheNearestInQuotesOrSaysNothing) {
  EXPECT_EQ(DidYouMean("lockstpe", {"lockstep", "free"}), "; did you mean 'lockstep'?");
  EXPECT_EQ(DidYouMean("everything", {"lockstep", "free"}), "");
  EXPECT_EQ(DidYouMean("lockstep", {}), "");
}

TEST(DidYouMean, HasWhatStandsAroundTheWrongWord) {
  EXPECT_EQ(Suggestion("noview", "--", ""), "; did you mean --noview?");
  EXPECT_EQ(Suggestion("", "--", ""), "");
}

}  // namespace
}  // namespace trajlo
