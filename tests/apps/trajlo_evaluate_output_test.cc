// SPDX-License-Identifier: MIT
// What the command leaves in its output folder, and that nothing there is lost.
#include <algorithm>
#include <cstdlib>

#include "tests/apps/trajlo_evaluate_testing.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(TrajloEvaluateTest, TheOutputHoldsEveryNumber) {
  const Outcome outcome =
      Call({"good.tum", "lost.tum", "--truth=" + Path("truth.tum"), Output(), "--report=false"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json json = Json();
  EXPECT_EQ(json["truth"]["poses"], 1000);
  ASSERT_EQ(json["estimates"].size(), 2u);
  const nlohmann::json& good = json["estimates"][0];
  EXPECT_EQ(good["name"], "good");
  EXPECT_EQ(good["diverged"], false);
  EXPECT_EQ(good["pairs"], 180);
  EXPECT_NEAR(good["ate"]["translation_m"]["rmse"].get<double>(), 0.005, 1e-4);
  EXPECT_EQ(good["rpe"][2]["unit"], "s");
  EXPECT_TRUE(good["kitti"].is_null());
  EXPECT_THAT(good["kitti_reason"].get<std::string>(), HasSubstr("too short"));
  EXPECT_EQ(good["alignment"]["T"].size(), 3u);
  EXPECT_EQ(json["estimates"][1]["diverged"], true);
  EXPECT_EQ(json["settings"]["association"]["rule"], "interpolate");
  EXPECT_FALSE(json["versions"]["trajlo"].get<std::string>().empty());

  const std::string errors = ReadFile(temp_ / "out" / good["errors_csv"].get<std::string>());
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 181);
  EXPECT_THAT(errors, AllOf(::testing::StartsWith("t_s,x_m,y_m,z_m,qx,qy,qz,qw,x_true_m,"),
                            HasSubstr("\n1.000000000,")));
  EXPECT_THAT(ReadFile(temp_ / "out/evaluation.csv"), HasSubstr("ate_translation_rmse_m"));
  EXPECT_THAT(ReadFile(temp_ / "out/evaluation.tex"),
              AllOf(HasSubstr("good & 0.00500 "), HasSubstr("lost & $\\times$")));
}

TEST_F(TrajloEvaluateTest, NothingIsOverwrittenUnasked) {
  ASSERT_EQ(Call({"good.tum", "truth.tum", Output(), "--report=false"}).exit_code, 0);
  const std::string first = ReadFile(temp_ / "out/evaluation.json");
  const Outcome outcome = Call({"worse.tum", "truth.tum", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("--overwrite"));
  EXPECT_EQ(ReadFile(temp_ / "out/evaluation.json"), first);
  EXPECT_EQ(Call({"worse.tum", "truth.tum", Output(), "--report=false", "--overwrite"}).exit_code,
            0);
  EXPECT_FALSE(std::filesystem::exists(temp_ / "out/errors_good.csv"));
  EXPECT_TRUE(std::filesystem::exists(temp_ / "out/errors_worse.csv"));
  WriteFile(temp_ / "file", "");
  EXPECT_EQ(Call({"good.tum", "truth.tum", "--output=" + Path("file")}).exit_code, 5);
  EXPECT_EQ(Call({"good.tum", "truth.tum", "--output=/proc/none/out"}).exit_code, 5);
}

TEST_F(TrajloEvaluateTest, AFullDiskIsAnErrorAndLeavesNoCompleteLookingResult) {
  const Outcome outcome = Call({"good.tum", "truth.tum", Output(), "--report=false"}, 5000);
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.err, HasSubstr("errors_good.csv"));
  EXPECT_TRUE(std::filesystem::is_empty(temp_ / "out"));
}

TEST_F(TrajloEvaluateTest, TheScriptDrawsTheOutputAndMayBeMissing) {
  setenv("TRAJLO_SCRIPTS", temp_.path().c_str(), 1);
  const Outcome missing = Call({"good.tum", "truth.tum", Output()});
  EXPECT_EQ(missing.exit_code, 0);
  EXPECT_THAT(missing.err, HasSubstr("no figures"));
  const auto write_script = [&](const std::string& text) {
    WriteFile(temp_ / "draw_evaluation.py", "#!/bin/sh\n" + text);
    std::filesystem::permissions(temp_ / "draw_evaluation.py", std::filesystem::perms::owner_all);
  };
  write_script("printf yes > \"$1/drawn\"\n");
  const Outcome drawn = Call({"good.tum", "truth.tum", Output(), "--overwrite"});
  EXPECT_EQ(drawn.exit_code, 0);
  EXPECT_EQ(drawn.err, "");
  EXPECT_EQ(ReadFile(temp_ / "out/drawn"), "yes");
  write_script("echo nothing to draw with >&2\nexit 1\n");
  const Outcome failed = Call({"good.tum", "truth.tum", Output(), "--overwrite"});
  EXPECT_EQ(failed.exit_code, 0);
  EXPECT_THAT(failed.err, AllOf(HasSubstr("nothing to draw with"), HasSubstr("no figures")));
  EXPECT_EQ(Json()["estimates"].size(), 1u);
  // The scripts end so where they cannot write.
  write_script("echo the disk is full >&2\nexit 5\n");
  const Outcome full = Call({"good.tum", "truth.tum", Output(), "--overwrite"});
  EXPECT_EQ(full.exit_code, 5);
  EXPECT_THAT(full.err, AllOf(HasSubstr("cannot be written"), Not(HasSubstr("numpy"))));
  unsetenv("TRAJLO_SCRIPTS");
}

TEST_F(TrajloEvaluateTest, QuietPrintsNothingWhenAllIsWell) {
  const Outcome outcome = Call({"good.tum", "truth.tum", "--quiet", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

}  // namespace
}  // namespace trajlo::testing
