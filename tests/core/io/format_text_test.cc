// SPDX-License-Identifier: MIT
#include "core/io/format_text.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

TEST(FormatText, IsNeverCut) {
  EXPECT_EQ(FormatText("%s has %d of %.1f s", "A", 2, 0.25), "A has 2 of 0.2 s");
  EXPECT_EQ(FormatText("%%"), "%");
  const std::string name(2000, 'x');
  EXPECT_EQ(FormatText("%s.csv", name.c_str()), name + ".csv");
}

TEST(CountOf, OneIsSingular) {
  EXPECT_EQ(CountOf(0, "scan"), "0 scans");
  EXPECT_EQ(CountOf(1, "scan"), "1 scan");
  EXPECT_EQ(CountOf(12U, "scan"), "12 scans");
  EXPECT_EQ(CountOf(1U, "scan is", "scans are"), "1 scan is");
  EXPECT_EQ(CountOf(2, "scan is", "scans are"), "2 scans are");
}

}  // namespace
}  // namespace trajlo
