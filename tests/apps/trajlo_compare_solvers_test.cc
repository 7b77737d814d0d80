// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/support/process.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::HasSubstr;

class TrajloCompareSolversTest : public ::testing::Test {
 protected:
  void SetUp() override {
    RoomRecording room;
    room.scans = 8;
    room.Write(temp_ / "in");
  }

  int Call(std::vector<std::string> more) {
    more.insert(more.begin(), {TRAJLO_COMPARE_SOLVERS, "--input=" + (temp_ / "in").string(),
                               "--output=" + (temp_ / "out").string(), "--report=false"});
    const Process process(more, 0);
    const int exit_code = process.Wait();
    out_ = process.Out();
    err_ = process.Err();
    return exit_code;
  }

  std::string Result(const std::string& name) const { return ReadFile(temp_ / "out" / name); }

  TempFolder temp_;
  std::string out_, err_;
};

TEST_F(TrajloCompareSolversTest, ComparesWindowsAndWholeRuns) {
  ASSERT_EQ(Call({"--only=gauss_newton,ceres,kernel_huber", "--every=2"}), 0) << err_;
  const auto json = nlohmann::json::parse(Result("comparison.json"));
  ASSERT_EQ(json["variants"].size(), 3u);
  const auto& ceres = json["variants"][1];
  EXPECT_EQ(ceres["name"], "ceres");
  EXPECT_LT(ceres["lockstep"]["max_from_first_m"].get<double>(), 1e-6);
  EXPECT_LT(ceres["free"]["max_from_first_m"].get<double>(), 1e-6);
  EXPECT_TRUE(ceres["free"]["parts_at_s"].is_null());
  EXPECT_TRUE(ceres["free"]["ate_rmse_m"].is_null());
  EXPECT_THAT(out_, HasSubstr("kernel_huber"));
  const std::string lockstep = Result("lockstep.csv");
  const auto windows = json["variants"][0]["lockstep"]["windows"].get<int>();
  EXPECT_EQ(std::count(lockstep.begin(), lockstep.end(), '\n'), 1 + 3 * windows);
  EXPECT_THAT(Result("iterations.csv"), HasSubstr("window,variant,step,cost\n0,gauss_newton,0,"));
  EXPECT_FALSE(Result("free/ceres/trajectory.tum").empty());
  EXPECT_THAT(Result("free_summary.csv"), HasSubstr("gauss_newton"));
}

TEST_F(TrajloCompareSolversTest, VariantsThatChangeMoreThanTheSolverAreComparedByWholeRuns) {
  WriteFile(temp_ / "mine.yaml",
            "variants:\n  - {name: all}\n  - {name: two, set: \"window.segments=2\"}\n");
  ASSERT_EQ(Call({"--variants=" + (temp_ / "mine.yaml").string()}), 0) << err_;
  const auto json = nlohmann::json::parse(Result("comparison.json"));
  EXPECT_TRUE(json["variants"][0].contains("lockstep"));
  EXPECT_FALSE(json["variants"][1].contains("lockstep"));
  EXPECT_TRUE(json["variants"][1].contains("free"));
  EXPECT_THAT(out_, HasSubstr("by whole runs only: two"));
}

TEST_F(TrajloCompareSolversTest, ErrorsHaveTheDocumentedCodes) {
  EXPECT_EQ(Call({"--only=nobody"}), 1);
  EXPECT_THAT(err_, HasSubstr("no variant 'nobody'"));
  EXPECT_EQ(Call({"--mode=fast"}), 1);
  EXPECT_EQ(Call({"--input=" + (temp_ / "missing").string()}), 2);
  ASSERT_EQ(Call({"--only=gauss_newton", "--mode=lockstep"}), 0) << err_;
  EXPECT_EQ(Call({"--only=gauss_newton", "--mode=lockstep"}), 5);
  EXPECT_EQ(Call({"--only=gauss_newton", "--mode=lockstep", "--overwrite"}), 0);
}

}  // namespace
}  // namespace trajlo::testing
