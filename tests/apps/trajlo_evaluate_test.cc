// SPDX-License-Identifier: MIT
// The command as a user calls it: what it says of estimates.
#include "core/scans/nanoseconds.h"
#include "tests/apps/trajlo_evaluate_testing.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(TrajloEvaluateTest, HelpTeachesByExample) {
  const Outcome outcome = Call({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("trajlo_evaluate estimate.tum truth.tum"),
                                 HasSubstr("--lever_arm="), Not(HasSubstr("tab_completion"))));
  EXPECT_THAT(Call({"--version"}).out, HasSubstr("trajlo_evaluate "));
}

TEST_F(TrajloEvaluateTest, OneEstimateIsShownWithAllItsStatistics) {
  const Outcome outcome = Call({"good.tum", "truth.tum"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  // Half of the poses are off by 10 mm: 5 mm around their mean.
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("ATE [m]         0.0050"), HasSubstr("RPE 1 m [deg]"),
                                 HasSubstr("RPE 1 s [m]"), HasSubstr("ground truth interpolated"),
                                 HasSubstr("180, 100.0 % of the poses"), HasSubstr("too short")));
}

TEST_F(TrajloEvaluateTest, SeveralEstimatesShareATableThatMarksTheBestAndTheDiverged) {
  const Outcome outcome = Call({"worse.tum", "good.tum", "lost.tum", "--truth=" + Path("truth.tum"),
                                "--names=peer,ours,third"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("0.00500 *"), HasSubstr("0.10000  "), HasSubstr("19.99999 x"),
                    HasSubstr("x third: the absolute error of 20 m is above 10 %")));
  EXPECT_LT(outcome.out.find("peer"), outcome.out.find("ours"));
}

TEST_F(TrajloEvaluateTest, ARunThatExplodedIsDivergedAndNotAnError) {
  TimedPoses poses = Disturbed(0.0);
  std::string text;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    text += std::to_string(Seconds(poses.t_ns[i])) + (i < 90 ? " 0 0 " : " 1e200 -1e180 ") +
            std::to_string(i) + " 0 0 0 1\n";
  }
  WriteFile(temp_ / "exploded.tum", text);
  const Outcome outcome = Call({"exploded.tum", "truth.tum", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("DIVERGED x  the absolute error is not finite"),
                                 Not(HasSubstr("nan"))));
  EXPECT_TRUE(Json()["estimates"][0]["ate"]["translation_m"]["rmse"].is_null());
}

TEST_F(TrajloEvaluateTest, AFolderOfAResultStandsForItsTrajectory) {
  std::filesystem::create_directories(temp_ / "result");
  WritePoses("result/trajectory.tum", Disturbed(0.01));
  const Outcome outcome = Call({"result/", "truth.tum", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json()["estimates"][0]["name"], "result");
}

TEST_F(TrajloEvaluateTest, WhatItsRunSaysAgainstAnEstimateIsSaidAgain) {
  std::filesystem::create_directory(temp_ / "result");
  WritePoses("result/trajectory.tum", Disturbed(0.01));
  WriteFile(temp_ / "result/run.json",
            R"({"exit": {"code": 4, "reason": "lost", "message": "lost at 3 s"}})");
  for (const char* name : {"result", "result/trajectory.tum"}) {
    const Outcome outcome = Call({name, "truth.tum"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(name), HasSubstr("lost at 3 s")));
  }
  EXPECT_THAT(Call({"good.tum", "truth.tum"}).err, Not(HasSubstr("lost")));
}

TEST_F(TrajloEvaluateTest, AShortRunIsIncompleteAndNotDiverged) {
  WritePoses("short.tum", SmoothPoses(1.0, 0.1, 80));
  const Outcome outcome = Call({"short.tum", "truth.tum", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("INCOMPLETE x  the estimate covers 39.6 %"),
                                 HasSubstr("--min_completeness=0"), Not(HasSubstr("DIVERGED"))));
  EXPECT_EQ(Json()["estimates"][0]["incomplete"], true);
  EXPECT_THAT(Call({"short.tum", "good.tum", "--truth=" + Path("truth.tum")}).out,
              HasSubstr("x short is incomplete: the estimate covers"));
  EXPECT_THAT(Call({"short.tum", "truth.tum", "--min_completeness=0"}).out,
              Not(HasSubstr("INCOMPLETE")));
}

TEST_F(TrajloEvaluateTest, RotationErrorsThatTheAlignmentLeavesOpenAreMarked) {
  TimedPoses truth, estimate;
  for (int i = 0; i < 100; ++i) {
    const double t_s = 0.1 * i;
    truth.t_ns.push_back(Nanoseconds(t_s));
    truth.T_world_body.emplace_back(
        Eigen::Translation3d(t_s, 0.0, 1e-4 * std::sin(t_s)) *
        Eigen::AngleAxisd(0.1 * std::sin(t_s), Eigen::Vector3d::UnitX()));
    estimate.t_ns.push_back(truth.t_ns.back());
    estimate.T_world_body.push_back(truth.T_world_body.back());
    estimate.T_world_body.back().pretranslate(
        Eigen::Vector3d(0.0, 0.002 * std::sin(2.0 * t_s), 0.002 * std::sin(t_s)));
  }
  WritePoses("line.tum", truth);
  WritePoses("off.tum", estimate);
  const Outcome one = Call({"off.tum", "line.tum", Output(), "--report=false"});
  EXPECT_THAT(one.err, HasSubstr("ATE [deg] says little"));
  EXPECT_THAT(one.out, HasSubstr("ATE [deg] ?"));
  const nlohmann::json json = Json()["estimates"][0];
  EXPECT_EQ(json["ate"]["rotation_determined"], false);
  EXPECT_GT(json["alignment"]["rotation_sigma_deg"], 10.0);
  EXPECT_THAT(ReadFile(temp_ / "out/evaluation.csv"), HasSubstr(",rotation_determined,"));
  const Outcome both = Call({"off.tum", "line.tum", "--truth=" + Path("line.tum")});
  EXPECT_THAT(both.out, AllOf(HasSubstr(" ? "), HasSubstr("? mostly a turn")));
  const Outcome by_origin = Call(
      {"off.tum", "line.tum", "--alignment=origin", Output(), "--report=false", "--overwrite"});
  EXPECT_THAT(by_origin.err, Not(HasSubstr("says little")));
  EXPECT_TRUE(Json()["estimates"][0]["alignment"]["rotation_sigma_deg"].is_null());
}

TEST_F(TrajloEvaluateTest, TruthOfASmallPartOfTheRunIsTold) {
  WritePoses("sliver.tum", SmoothPoses(18.0, 0.02, 1000));
  const Outcome outcome = Call({"good.tum", "sliver.tum", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("of the estimate could be compared with the ground truth"));
  EXPECT_THAT(Json()["warnings"].dump(), HasSubstr("could be compared"));
  EXPECT_LT(Json()["estimates"][0]["covered_share"].get<double>(), 0.5);
  EXPECT_THAT(ReadFile(temp_ / "out/evaluation.csv"), HasSubstr(",covered_share,"));
}

TEST_F(TrajloEvaluateTest, AnEstimateThatCannotBeComparedDoesNotHideTheOthers) {
  WriteFile(temp_ / "empty.tum", "");
  const Outcome both =
      Call({"good.tum", "empty.tum", "--truth=" + Path("truth.tum"), Output(), "--report=false"});
  EXPECT_EQ(both.exit_code, 3);
  EXPECT_THAT(both.err, HasSubstr("empty.tum: holds no poses"));
  EXPECT_THAT(both.out, HasSubstr("x empty: "));
  const nlohmann::json failed = Json()["estimates"][1];
  EXPECT_EQ(failed["diverged"], true);
  EXPECT_TRUE(failed["ate"].is_null());
  const Outcome alone = Call({"empty.tum", "truth.tum", "--output=" + Path("other")});
  EXPECT_EQ(alone.exit_code, 2);
  EXPECT_EQ(alone.out, "");
  EXPECT_FALSE(std::filesystem::exists(temp_ / "other"));
  EXPECT_EQ(Call({"good.tum", "missing.tum"}).exit_code, 2);
}

TEST_F(TrajloEvaluateTest, NoOverlapNamesBothTimeSpansAndGivesNoNumbers) {
  WritePoses("later.tum", SmoothPoses(1000.0, 0.1, 50));
  const Outcome outcome = Call({"later.tum", "truth.tum"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("1000.000 to 1004.900 s"), HasSubstr("0.000 to 19.980"),
                                 HasSubstr("--time_offset_s=-1000.000")));
}

TEST_F(TrajloEvaluateTest, WrongUsageIsExplained) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"--rpe=10", "--rpe"},
      {"--rpe=1.5f", "--rpe"},
      {"--alignment=umeyama", "se3, sim3"},
      {"--association=linear", "nearest"},
      {"--align_first=-1", "--align_first"},
      {"--lever_arm=1,2", "x,y,z"},
      {"--T_body_truth=1,2,3", "qx,qy,qz,qw"},
      {"--T_body_truth=0,0,0,0,0,0,9", "normalised"},
      {"--names=a,b", "1 different names"},
      {"--format=bag", "--format"},
      {"--min_completeness=50", "--min_completeness"},
  };
  for (const auto& [flag, message] : wrong) {
    const Outcome outcome = Call({"good.tum", "truth.tum", flag});
    EXPECT_EQ(outcome.exit_code, 1) << flag;
    EXPECT_THAT(outcome.err, HasSubstr(message)) << flag;
  }
  EXPECT_EQ(Call({"good.tum"}).exit_code, 1);
  EXPECT_EQ(Call({"--truth=" + Path("truth.tum")}).exit_code, 1);
  EXPECT_EQ(Call({"good.tum", "truth.tum", "--lever_arm=1,2,3", "--T_body_truth=1,2,3,0,0,0,1"})
                .exit_code,
            1);
}

TEST_F(TrajloEvaluateTest, APrismOnTheBodyIsReachedByItsLeverArm) {
  TimedPoses prism = InFrame(SmoothPoses(0.0, 0.02, 1000),
                             Eigen::Affine3d(Eigen::Translation3d(-0.3, 0.1, -0.25)));
  for (Eigen::Affine3d& T : prism.T_world_body) T.linear().setIdentity();
  WritePoses("prism.tum", prism);
  const Outcome outcome = Call({"good.tum", "prism.tum", "--lever_arm=-0.3,0.1,-0.25"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("placeholders"));
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("0.0050"), HasSubstr("dist. [m]"), Not(HasSubstr("[deg]"))));
}

TEST_F(TrajloEvaluateTest, KittiTruthOfAnotherFrameNeedsTimesAndAnExtrinsic) {
  const Eigen::Affine3d T_body_camera =
      Eigen::Translation3d(0.3, -0.2, 0.5) * Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  const TimedPoses camera = InFrame(SmoothPoses(0.0, 0.02, 1000), T_body_camera);
  std::string times;
  KittiWriter writer(temp_ / "camera.txt");
  for (std::size_t i = 0; i < camera.size(); ++i) {
    writer.Append(SE3(Eigen::Quaterniond(camera.T_world_body[i].linear()),
                      camera.T_world_body[i].translation()));
    times += std::to_string(Seconds(camera.t_ns[i])) + "\n";
  }
  writer.Close();
  WriteFile(temp_ / "times.txt", times);
  EXPECT_THAT(Call({"good.tum", "camera.txt"}).err, HasSubstr("--times"));
  const std::string extrinsic = "--T_body_truth=0.3,-0.2,0.5,-0.5,0.5,-0.5,0.5";
  const Outcome outcome =
      Call({"good.tum", "camera.txt", "--times=" + Path("times.txt"), extrinsic});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("kitti, 1000 poses"), HasSubstr("0.0050")));
  WriteFile(temp_ / "times.txt", "0\n1\n");
  EXPECT_THAT(Call({"good.tum", "camera.txt", "--times=" + Path("times.txt")}).err,
              HasSubstr("2 stamps"));
}

TEST_F(TrajloEvaluateTest, ATimeOffsetIsFoundAndReported) {
  TimedPoses late = Disturbed(0.0);
  for (std::int64_t& t_ns : late.t_ns) t_ns += 123'000'000;
  WritePoses("late.tum", late);
  const Outcome outcome =
      Call({"late.tum", "truth.tum", "--estimate_time_offset", Output(), "--report=false"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("time offset -0.123"));
  EXPECT_NEAR(Json()["estimates"][0]["time_offset_s"].get<double>(), -0.123, 1e-4);
}

TEST_F(TrajloEvaluateTest, NoBestOfEstimatesThatCoverDifferentParts) {
  TimedPoses part = Disturbed(0.004);
  part.t_ns.resize(part.t_ns.size() * 8 / 10);
  part.T_world_body.resize(part.t_ns.size());
  WritePoses("part.tum", part);
  const Outcome outcome = Call({"good.tum", "part.tum", "--truth=" + Path("truth.tum")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("no best is marked"), Not(HasSubstr(" *"))));
}

}  // namespace
}  // namespace trajlo::testing
