// SPDX-License-Identifier: MIT
#include "core/report/drawn_files.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class RemoveComparisonTest : public ::testing::Test {
 protected:
  void Write(const Names& names) const {
    for (const std::string& name : names) {
      fs::create_directories((temp_ / name).parent_path());
      WriteFile(temp_ / name, "x");
    }
  }
  bool Exists(const std::string& name) const { return fs::exists(temp_ / name); }

  TempFolder temp_;
};

TEST_F(RemoveComparisonTest, NothingOfItStays) {
  Write({"comparison.json", "config.yaml", "lockstep.csv", "iterations.csv", "lockstep_summary.csv",
         "free_summary.csv", "report.html", "figures/cost.svg", "figures/stages.pdf",
         "figures/distances.png", "figures/points.svg", "figures/free.png",
         "free/ceres/trajectory.tum", "free/ceres/windows.csv"});
  RemoveComparison(temp_.path());
  EXPECT_TRUE(fs::is_empty(temp_.path()));
}

TEST_F(RemoveComparisonTest, WhatOthersDrewOrWroteStays) {
  Write({"comparison.json", "figures/cost.svg", "free/ceres/trajectory.tum"});
  const Names others = {"notes.txt",        "truth.tum",          "figures/mine.png",
                        "figures/cost.txt", "figures/map.svg",    "figures/deep/cost.svg",
                        "free/notes.txt",   "free/ceres/mine.csv"};
  Write(others);
  RemoveComparison(temp_.path());
  for (const std::string& name : others) EXPECT_TRUE(Exists(name)) << name;
  for (const char* name : {"comparison.json", "figures/cost.svg", "free/ceres/trajectory.tum"}) {
    EXPECT_FALSE(Exists(name)) << name;
  }
}

TEST_F(RemoveComparisonTest, LinksAndWhatTheyPointToStay) {
  Write({"comparison.json", "elsewhere/cost.svg"});
  fs::create_directories(temp_ / "figures");
  fs::create_symlink(temp_ / "elsewhere/cost.svg", temp_ / "figures/cost.svg");
  RemoveComparison(temp_.path());
  EXPECT_TRUE(fs::is_symlink(temp_ / "figures/cost.svg"));
  EXPECT_TRUE(Exists("elsewhere/cost.svg"));
}

}  // namespace
}  // namespace trajlo::testing
