// SPDX-License-Identifier: MIT
#include "core/report/run_json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/io/errors.h"
#include "core/report/resource_usage.h"
#include "core/report/summary_table.h"
#include "core/report/versions.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using trajlo::testing::TempFolder;

RunSummary ExampleSummary() {
  RunSummary s;
  s.exit_code = 4;
  s.exit_reason = "lost";
  s.command_line = {"trajlo_run", "--input=a \"b\""};
  s.inputs = {"a"};
  s.output = "out";
  s.read.scans_listed = 12;
  s.read.scans_read = 11;
  s.read.scans_skipped = 1;
  s.points.received = 1000;
  s.points.not_finite = 10;
  s.points.too_near = 20;
  s.times.retimed = 2;
  s.times.clock_steps = 1;
  s.begin_ns = 1'700'000'000'000'000'001;
  s.end_ns = 1'700'000'002'000'000'001;
  s.lost_at_ns = 1'700'000'001'000'000'001;
  s.wall_s = 0.5;
  s.warnings = {"scan 3 is short"};
  WindowStatistics window;
  window.points = 100;
  window.inliers = 80;
  window.flags = kFlagGap | kFlagLost;
  s.flags = PoseFlags({{0, SE3(), 0}, {1'000'000'000, SE3(), kFlagGap}}, std::nullopt);
  window.milliseconds_solve = 3.0;
  s.windows.Add(window);
  return s;
}

TEST(RunJson, SaysWhereTheRecordingWas) {
  RunSummary s;
  s.inputs = {"sub/../a.bag", "/b.bag"};
  const auto input = nlohmann::json::parse(RunJson(s))["input"];
  EXPECT_EQ(input["paths"][0], "sub/../a.bag");
  EXPECT_EQ(input["absolute_paths"][0], (std::filesystem::current_path() / "a.bag").string());
  EXPECT_EQ(input["absolute_paths"][1], "/b.bag");
}

TEST(RunSummary, ManyScansThatRepeatPointsAreAShortcoming) {
  RunSummary s;
  s.times.scans = s.times.until_last_point = 100;
  s.times.stuck = 5;
  EXPECT_EQ(s.Shortcomings(), "");
  EXPECT_THAT(s.OddStamps(), HasSubstr("5 dropped (the points of a scan before"));
  s.times.stuck = 6;
  EXPECT_THAT(s.Shortcomings(), HasSubstr("6 of 100 scans have the points of a scan before"));
  EXPECT_EQ(nlohmann::json::parse(RunJson(s))["input"]["scans"]["points_repeated"], 6);
}

TEST(RunSummary, APointIsDroppedForOneReason) {
  RunSummary s = ExampleSummary();
  s.read.points_without_time = 4;  // the segmenter sees them as points that are not finite
  const auto points = nlohmann::json::parse(RunJson(s))["input"]["points"];
  EXPECT_EQ(points["not_finite"], 6);
  EXPECT_EQ(points["without_time"], 4);
  EXPECT_THAT(SummaryTable(s), HasSubstr("6 not finite"));
  EXPECT_THAT(SummaryTable(s), HasSubstr("4 without a possible time"));
}

TEST(RunSummary, SaysWhatIsMissingOnlyWhereItIsMoreThanALittle) {
  RunSummary s;
  EXPECT_EQ(s.Shortcomings(), "");
  s.points.received = 1000;
  s.points.too_late = 20;
  s.points.wrong_time = 20;
  s.read.points_without_time = 10;
  s.times.scans = s.times.until_last_point = 100;
  s.times.assumed = 3;
  s.times.retimed = 2;
  s.times.reordered = 50;
  EXPECT_EQ(s.Shortcomings(), "");
  s.read.points_without_time = 11;
  EXPECT_EQ(
      s.Shortcomings(),
      "5 % of the points were dropped because of their times (20 too late, 20 of wrong stamps, "
      "11 impossible, as NaN is)");
  s.points = {};
  s.times.assumed = 4;
  EXPECT_EQ(s.Shortcomings(), "the times of 6 of 100 scans are not those of their stamps");
  s.times.assumed = 0;
  s.times.moved = 4;
  EXPECT_EQ(s.Shortcomings(), "the times of 6 of 100 scans are not those of their stamps");
  s.times.moved = 0;
  s.times.odd_point_times = 6;
  EXPECT_EQ(s.Shortcomings(), "of 100 scans some have a single time for all points, or none");
  s.times.odd_point_times = 5;
  s.times.exchanged = 6;
  EXPECT_EQ(s.Shortcomings(), "6 of 100 scans may be out of order, by what they show");
  s.times.exchanged = 5;
  s.times.before_first_pose = 6;
  EXPECT_EQ(s.Shortcomings(),
            "the first 6 of 100 scans show nothing, or too little, of the world: the trajectory "
            "begins after them");
  s.times.before_first_pose = 5;
  s.times.until_last_point = 95;
  EXPECT_EQ(s.Shortcomings(), "");
  s.times.until_last_point = 94;
  EXPECT_EQ(s.Shortcomings(),
            "the last 6 of 100 scans have no point that can be used: the trajectory ends before "
            "them");
  s.points.received = 1000;
  s.points.too_far = 60;
  EXPECT_THAT(s.Shortcomings(),
              ::testing::EndsWith("before them (6 % of all points are beyond sensor.max_range_m)"));
  s.points = {};
  s.times.until_last_point = 100;
  s.begin_ns = 0;
  s.end_ns = 10'000'000'000;
  s.points.sight_lines = {1000, 400};
  EXPECT_THAT(s.Shortcomings(), ::testing::HasSubstr("in 40 % of all directions"));
  s.path_length_m = 3.0;
  EXPECT_EQ(s.Shortcomings(), "");
  s.path_length_m = 0.0;
  s.points.sight_lines = {1000, 100};
  EXPECT_EQ(s.Shortcomings(), "");
  s.begin_ns = 0;
  s.end_ns = 10'000'000'000;
  s.times.doubtful_end_s = 0.5;
  EXPECT_EQ(s.Shortcomings(), "");
  s.times.doubtful_end_s = 2.45;
  EXPECT_EQ(s.Shortcomings(),
            "by its stamp, the last scan comes 2.5 s after the one before; nothing confirms that, "
            "and it was left out");
  s.times.doubtful_end_s = 0.0;
  s.times.doubtful_begin_s = 2.2;
  EXPECT_EQ(s.Shortcomings(),
            "by its stamp, the first scan comes 2.2 s before the next; nothing confirms that, and "
            "it was left out");
  s.times.doubtful_begin_s = 0.0;
  s.read.file_is_cut = true;
  s.times.clocks_may_differ = true;
  EXPECT_EQ(s.Shortcomings(),
            "a part of the file is missing or broken, and the clocks of the LiDARs may differ");
}

TEST(RunSummary, SaysThatNothingConfirmsAShortRecordingOrThatALidarDoesNotFit) {
  RunSummary s;
  s.too_short = true;
  EXPECT_THAT(s.Shortcomings(), HasSubstr("too short for a window"));
  s.too_short = false;
  s.rig.resize(2);
  s.rig[1].lidar = 1;
  for (const RigEvidence fits :
       {RigEvidence::kNotYet, RigEvidence::kNone, RigEvidence::kConfirmed}) {
    s.rig[1].evidence = fits;
    EXPECT_EQ(s.Shortcomings(), "");
  }
  s.rig[1].evidence = RigEvidence::kContradicted;
  EXPECT_THAT(s.Shortcomings(), HasSubstr("LiDAR 1 does not fit the others"));
}

TEST(RunSummary, SaysThatHardlyAPoseCanBeReliedOn) {
  constexpr int kPoses = 101;
  std::vector<ControlPose> poses(kPoses);
  for (int i = 0; i < kPoses; ++i) {
    poses[i].t_ns = i * 100'000'000LL;
    poses[i].flags = i < 95 ? kFlagFewInliers : 0U;
  }
  RunSummary s;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");  // 0.6 of 10 s are good.
  poses[95].flags = poses[96].flags = kFlagJump;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(),
            "9.60 of 10.00 s have a flag (flags.csv): almost no pose can be trusted");
  // What nothing confirms is said once.
  for (ControlPose& pose : poses) pose.flags = kFlagJump | kFlagDegenerate;
  s.flags = PoseFlags(poses, std::nullopt);
  s.too_short = true;
  EXPECT_THAT(s.Shortcomings(), Not(HasSubstr("flag")));
}

TEST(RunSummary, SaysThatADirectionWasOpenForLong) {
  constexpr int kPoses = 1001;
  std::vector<ControlPose> poses(kPoses);
  for (int i = 0; i < kPoses; ++i) poses[i].t_ns = i * 100'000'000LL;
  for (int i = 100; i < 150; ++i) poses[i].flags = poses[i + 100].flags = kFlagDegenerate;
  RunSummary s;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");  // Five seconds, twice.
  poses[150].flags = kFlagDegenerate;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(
      s.Shortcomings(),
      "for 5.10 s on end the points left a direction open (flag degenerate): nothing tells how "
      "the body moved along or about it");
}

TEST(RunSummary, SaysThatADirectionWasOpenForMostOfTheTime) {
  std::vector<ControlPose> poses(101);
  for (int i = 0; i <= 100; ++i) poses[i].t_ns = i * 100'000'000LL;
  for (int i = 0; i < 33; ++i) poses[3 * i + 1].flags = poses[3 * i + 2].flags = kFlagDegenerate;
  RunSummary s;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");  // 6.6 s of 10, never for long.
  poses[3].flags = kFlagDegenerate;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(),
            "for 6.70 of 10.00 s the points left a direction open (flag degenerate): nothing tells "
            "how the body moved along or about it");
}

TEST(RunSummary, SaysThatPosesWereInDoubtForAQuarterOfTheTime) {
  std::vector<ControlPose> poses(101);
  for (int i = 0; i <= 100; ++i) poses[i].t_ns = i * 100'000'000LL;
  for (int i = 0; i < 24; ++i) poses[4 * i + 1].flags = kFlagJump;
  RunSummary s;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");
  poses[2].flags = poses[6].flags = kFlagJump;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(),
            "for 2.60 of 10.00 s poses jump further than a body can move, or have been in doubt "
            "since then (flag jump)");
}

TEST(RunSummary, SaysThatOneObjectHeldTheBodyForAQuarterOfTheTime) {
  std::vector<ControlPose> poses(101);
  for (int i = 0; i <= 100; ++i) poses[i].t_ns = i * 100'000'000LL;
  for (int i = 1; i <= 24; ++i) poses[i].flags = kFlagLoneObject;
  RunSummary s;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");
  poses[25].flags = poses[26].flags = kFlagLoneObject;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(),
            "for 2.60 of 10.00 s one object alone holds a direction, and the rest of the world "
            "contradicts it (flag lone_object): it may move along with the body, as a truck ahead "
            "does");
}

TEST(RunSummary, SaysThatNothingWasMeasuredForLong) {
  constexpr std::int64_t kMillisecond = 1'000'000;
  std::vector<ControlPose> poses = {{0, {}, 0}, {9500 * kMillisecond, {}, 0}, {0, {}, kFlagGap}};
  RunSummary s;
  poses[2].t_ns = 9990 * kMillisecond;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(), "");
  poses[2].t_ns = 10010 * kMillisecond;
  s.flags = PoseFlags(poses, std::nullopt);
  EXPECT_EQ(s.Shortcomings(),
            "for 0.51 of 10.01 s nothing was measured, or the place was not found");
}

TEST(RunSummary, NamesTopicsWithoutAMessage) {
  RunSummary s;
  s.read.topics_without_messages = {"/b"};
  EXPECT_EQ(s.Shortcomings(), "topic /b has no message");
  EXPECT_EQ(nlohmann::json::parse(RunJson(s))["input"]["topics_without_messages"][0], "/b");
}

TEST(RunSummary, SaysThatHeadersDeclareTooFewPointsWhereTheyAreMoreThanALittle) {
  RunSummary s;
  s.read.points_read = 1900;
  s.read.points_undeclared = 100;
  EXPECT_EQ(s.Shortcomings(), "");
  s.read.points_undeclared = 101;
  EXPECT_THAT(s.Shortcomings(), HasSubstr("101 points behind those that the headers"));
  EXPECT_EQ(nlohmann::json::parse(RunJson(s))["input"]["points"]["undeclared"], 101);
}

TEST(RunSummary, CountsOddStampsByReason) {
  RunSummary s;
  EXPECT_EQ(s.OddStamps(), "");
  s.times.reordered = 3;
  s.times.misfits = 1;
  EXPECT_EQ(s.OddStamps(), "3 put in order, 1 dropped (their stamps fit nowhere)");
  EXPECT_THAT(SummaryTable(s), HasSubstr("3 put in order"));
}

TEST(RunJson, HoldsTheSummary) {
  const nlohmann::json json = nlohmann::json::parse(RunJson(ExampleSummary()));
  EXPECT_EQ(json["exit"]["code"], 4);
  EXPECT_EQ(json["exit"]["reason"], "lost");
  EXPECT_EQ(json["command_line"][1], "--input=a \"b\"");
  EXPECT_EQ(json["input"]["scans"]["skipped"], 1);
  EXPECT_EQ(json["input"]["scans"]["retimed"], 2);
  EXPECT_EQ(json["input"]["clock_steps"], 1);
  EXPECT_EQ(json["input"]["points"]["kept"], 970);
  EXPECT_EQ(json["result"]["begin_s"], "1700000000.000000001");
  EXPECT_EQ(json["result"]["duration_s"], 2.0);
  EXPECT_EQ(json["result"]["lost_at_s"], "1700000001.000000001");
  EXPECT_EQ(json["windows"]["inlier_share"], 0.8);
  EXPECT_EQ(json["windows"]["flagged"]["gap"], 1);
  EXPECT_EQ(json["windows"]["flagged"]["reverted"], 0);
  EXPECT_EQ(json["resources"]["real_time_factor"], 4.0);
  EXPECT_EQ(json["resources"]["stages_ms"]["solve"], 3.0);
  EXPECT_EQ(json["versions"]["eigen"], "3.4.0");
  EXPECT_EQ(json["warnings"].size(), 1u);
}

TEST(RunJson, ARunWithoutAResultIsStillValid) {
  const nlohmann::json json = nlohmann::json::parse(RunJson({}));
  EXPECT_TRUE(json["result"]["begin_s"].is_null());
  EXPECT_EQ(json["exit"]["reason"], "running");
  EXPECT_TRUE(json["exit"]["code"].is_null());
}

TEST(RunJson, SurvivesPathsThatAreNotUtf8) {
  RunSummary s;
  s.output = "out\xff";
  EXPECT_TRUE(nlohmann::json::accept(RunJson(s)));
}

TEST(RunJson, ReplacesTheFileAndReportsAFullDisk) {
  const TempFolder temp;
  WriteRunJson(temp / "run.json", {});
  WriteRunJson(temp / "run.json", ExampleSummary());
  EXPECT_EQ(trajlo::testing::ReadFile(temp / "run.json"), RunJson(ExampleSummary()));
  EXPECT_THROW(WriteRunJson("/dev/full", {}), OutputError);
}

TEST(SummaryTable, NamesWhatMatters) {
  const std::string table = SummaryTable(ExampleSummary());
  EXPECT_THAT(table, HasSubstr("11 of 12 scans"));
  EXPECT_THAT(table, HasSubstr("10 not finite, 20 too near of 1000 points"));
  EXPECT_THAT(table, HasSubstr("80 % inliers"));
  EXPECT_THAT(table, HasSubstr("gap 1 (1.00 s)"));
  EXPECT_THAT(table, HasSubstr("4.0 x real time"));
  EXPECT_THAT(table, HasSubstr("at 1700000001.000000001 s"));
  EXPECT_THAT(table, HasSubstr("lost (exit code 4), in out"));
}

TEST(SummaryTable, AnEmptyRunHasNoNan) {
  EXPECT_EQ(SummaryTable({}).find("nan"), std::string::npos);
  EXPECT_THAT(SummaryTable({}), HasSubstr("windows     none"));
}

TEST(Versions, AreKnown) {
  const Versions versions = GetVersions();
  EXPECT_FALSE(versions.trajlo.empty());
  EXPECT_FALSE(versions.git.empty());
  EXPECT_THAT(versions.ceres, HasSubstr("2."));
}

TEST(RunSummary, TakesWhatThePosesTell) {
  RunSummary s;
  s.TakePoses({});
  EXPECT_FALSE(s.begin_ns);
  std::vector<ControlPose> poses(3);
  poses[0].t_ns = 1'000'000'000;
  poses[1].t_ns = 2'000'000'000;
  poses[1].T_world_body.t = {3.0, 0.0, 0.0};
  poses[2].t_ns = 4'000'000'000;
  poses[2].T_world_body.t = {3.0, 4.0, 0.0};
  s.TakePoses(poses);
  EXPECT_DOUBLE_EQ(s.DataSeconds(), 3.0);
  EXPECT_DOUBLE_EQ(s.path_length_m, 7.0);
  EXPECT_DOUBLE_EQ(s.distance_to_start_m, 5.0);
}

TEST(ResourceUsage, IsPlausible) {
  EXPECT_GT(PeakMemoryMegabytes(), 1.0);
  EXPECT_GE(ProcessCpuSeconds(), 0.0);
}

}  // namespace
}  // namespace trajlo
