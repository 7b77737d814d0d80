// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/apps/command_testing.h"
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

  Outcome Call(std::vector<std::string> more, const std::string& input = "") const {
    more.insert(more.begin(), {"--input=" + (input.empty() ? (temp_ / "in").string() : input),
                               "--output=" + (temp_ / "out").string(), "--report=false"});
    return CallProgram(TRAJLO_COMPARE_SOLVERS, more);
  }

  std::string Result(const std::string& name) const { return ReadFile(temp_ / "out" / name); }

  TempFolder temp_;
};

TEST_F(TrajloCompareSolversTest, ComparesWindowsAndWholeRuns) {
  const Outcome outcome = Call({"--only=gauss_newton,ceres,kernel_huber", "--every=2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(Result("comparison.json"));
  EXPECT_TRUE(json["is_whole"].get<bool>());
  ASSERT_EQ(json["variants"].size(), 3u);
  const auto& ceres = json["variants"][1];
  EXPECT_EQ(ceres["name"], "ceres");
  EXPECT_LT(ceres["lockstep"]["max_from_first_m"].get<double>(), 1e-6);
  EXPECT_LT(ceres["free"]["max_from_first_m"].get<double>(), 1e-6);
  EXPECT_TRUE(ceres["free"]["parts_at_s"].is_null());
  EXPECT_TRUE(ceres["free"]["ate_rmse_m"].is_null());
  EXPECT_THAT(outcome.out, HasSubstr("kernel_huber"));
  const std::string lockstep = Result("lockstep.csv");
  const auto windows = json["variants"][0]["lockstep"]["windows"].get<int>();
  EXPECT_EQ(std::count(lockstep.begin(), lockstep.end(), '\n'), 1 + 3 * windows);
  EXPECT_THAT(Result("iterations.csv"), HasSubstr("window,variant,step,cost\n0,gauss_newton,0,"));
  EXPECT_FALSE(Result("free/ceres/trajectory.tum").empty());
  EXPECT_THAT(Result("free_summary.csv"), HasSubstr("gauss_newton"));
  EXPECT_THAT(Result("free_summary.csv"), HasSubstr(",median_solve_ms,"));
  EXPECT_GT(ceres["free"]["median_solve_ms"].get<double>(), 0.0);
}

TEST_F(TrajloCompareSolversTest, VariantsThatChangeMoreThanTheSolverAreComparedByWholeRuns) {
  WriteFile(temp_ / "mine.yaml",
            "variants:\n  - {name: all}\n  - {name: two, set: \"window.segments=2\"}\n");
  const Outcome outcome = Call({"--variants=" + (temp_ / "mine.yaml").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(Result("comparison.json"));
  EXPECT_TRUE(json["variants"][0].contains("lockstep"));
  EXPECT_FALSE(json["variants"][1].contains("lockstep"));
  EXPECT_TRUE(json["variants"][1].contains("free"));
  EXPECT_THAT(outcome.out,
              HasSubstr("by whole runs only, as more changes than how a window is solved: two"));
}

TEST_F(TrajloCompareSolversTest, AVariantThatIsAnotherOneOnceMoreIsTold) {
  WriteFile(temp_ / "mine.yaml",
            "variants:\n  - {name: gn, set: \"solver.kind=gauss_newton\"}\n  - {name: gn_qr, set: "
            "\"solver.kind=gauss_newton,expert.solver.ceres.linear_solver=dense_qr\"}\n");
  const Outcome outcome = Call({"--variants=" + (temp_ / "mine.yaml").string(), "--mode=lockstep"});
  EXPECT_EQ(outcome.exit_code, 0);
  const char* said = "'gn_qr': expert.solver.ceres.linear_solver has no effect";
  EXPECT_THAT(outcome.err, HasSubstr(std::string("warning: ") + said));
  EXPECT_THAT(nlohmann::json::parse(Result("comparison.json"))["warnings"].dump(), HasSubstr(said));
}

TEST_F(TrajloCompareSolversTest, EveryRowHasAllColumnsWhereTrajectoriesPart) {
  ASSERT_EQ(Call({"--only=gauss_newton,kernel_huber", "--mode=free"}).exit_code, 0);
  const auto json = nlohmann::json::parse(Result("comparison.json"));
  ASSERT_TRUE(json["variants"][1]["free"]["parts_at_s"].is_string());
  std::istringstream lines(Result("free_summary.csv"));
  std::string names, line;
  std::getline(lines, names);
  while (std::getline(lines, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','),
              std::count(names.begin(), names.end(), ','))
        << line;
  }
  EXPECT_THAT(line = Result("free_summary.csv"),
              HasSubstr(json["variants"][1]["free"]["parts_at_s"].get<std::string>()));
}

TEST_F(TrajloCompareSolversTest, NothingOfAnEarlierComparisonStays) {
  ASSERT_EQ(Call({"--only=gauss_newton,kernel_huber"}).exit_code, 0);
  ASSERT_EQ(Call({"--only=ceres", "--mode=free", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(temp_ / "out/lockstep.csv"));
  EXPECT_FALSE(std::filesystem::exists(temp_ / "out/free/kernel_huber"));
  EXPECT_TRUE(std::filesystem::exists(temp_ / "out/free/ceres/trajectory.tum"));
}

TEST_F(TrajloCompareSolversTest, WhatIsInAFolderWithoutAComparisonStays) {
  std::filesystem::create_directories(temp_ / "out/figures");
  WriteFile(temp_ / "out/figures/mine.png", "mine");
  ASSERT_EQ(Call({"--only=ceres", "--mode=free", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(Result("figures/mine.png"), "mine");
}

TEST_F(TrajloCompareSolversTest, DamageOfTheInputIsToldAndHasItsExitCode) {
  WriteFile(temp_ / "in" / "scans" / "000003.pcd", "no cloud");
  const Outcome outcome = Call({"--only=gauss_newton"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("000003.pcd"));
  EXPECT_FALSE(Result("comparison.json").empty());
}

TEST_F(TrajloCompareSolversTest, ATruthOfAnotherTimeIsRefusedBeforeTheFirstRun) {
  const std::string truth = temp_ / "truth.tum";
  for (const char* stamps : {"10", "999999"}) {
    WriteFile(truth, std::string(stamps) + " 0 0 0 0 0 0 1\n" + stamps + ".5 0 0 0 0 0 0 1\n");
    const Outcome outcome = Call({"--only=gauss_newton", "--truth=" + truth});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("is of another time than the recording"));
    EXPECT_THAT(outcome.err, HasSubstr("begins at about 1000."));
    EXPECT_FALSE(std::filesystem::exists(temp_ / "out"));
  }
  // It overlaps, but a single place aligns nothing.
  WriteFile(truth, "1000 0 0 0 0 0 0 1\n1001 0 0 0 0 0 0 1\n");
  const Outcome outcome =
      Call({"--only=gauss_newton", "--mode=free", "--truth=" + truth, "--overwrite"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no run could be compared with the truth"));
}

TEST_F(TrajloCompareSolversTest, AWrongFirstStampDoesNotRefuseAGoodTruth) {
  std::ofstream stamps(temp_ / "in/timestamps.txt");
  stamps << "5.0\n";
  for (int i = 1; i < 8; ++i) stamps << RoomRecording::kStart + i * RoomRecording::kPeriod << "\n";
  stamps.close();
  WriteFile(temp_ / "truth.tum", "1000 0 0 0 0 0 0 1\n1001 0 0 0 0 0 0 1\n");
  const Outcome outcome =
      Call({"--only=gauss_newton", "--mode=lockstep", "--truth=" + (temp_ / "truth.tum").string()});
  EXPECT_NE(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, ::testing::Not(HasSubstr("is of another time")));
  EXPECT_FALSE(Result("comparison.json").empty());
}

TEST_F(TrajloCompareSolversTest, WithoutAWindowNothingIsCompared) {
  RoomRecording room;
  room.scans = 1;
  room.Write(temp_ / "one");
  const Outcome outcome =
      Call({"--only=gauss_newton,ceres", "--set=segmenter.interval_s=0.2"}, temp_ / "one");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("nothing was compared"));
  EXPECT_EQ(outcome.out, "");
}

TEST_F(TrajloCompareSolversTest, AVariantIsNamedOnce) {
  const Outcome outcome = Call({"--only=gauss_newton,ceres,gauss_newton"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("'gauss_newton' appears twice"));
}

TEST_F(TrajloCompareSolversTest, ErrorsHaveTheDocumentedCodes) {
  const Outcome unknown = Call({"--only=nobody"});
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("no variant 'nobody'; there are: gauss_newton "));
  EXPECT_THAT(Call({"--only=gauss_newton,cerse"}).err,
              HasSubstr("no variant 'cerse'; did you mean 'ceres'?"));
  EXPECT_EQ(Call({"--mode=fast"}).exit_code, 1);
  EXPECT_THAT(Call({"--mode=lockstpe"}).err,
              HasSubstr("found 'lockstpe'; did you mean 'lockstep'?"));
  const Outcome two_lidars = Call({}, "a,b");
  EXPECT_EQ(two_lidars.exit_code, 1);
  EXPECT_THAT(two_lidars.err, HasSubstr("sensor.T_body_lidar is empty"));
  EXPECT_EQ(Call({}, temp_ / "missing").exit_code, 2);
  ASSERT_EQ(Call({"--only=gauss_newton", "--mode=lockstep"}).exit_code, 0);
  EXPECT_EQ(Call({"--only=gauss_newton", "--mode=lockstep"}).exit_code, 5);
  EXPECT_EQ(Call({"--only=gauss_newton", "--mode=lockstep", "--overwrite"}).exit_code, 0);
}

}  // namespace
}  // namespace trajlo::testing
