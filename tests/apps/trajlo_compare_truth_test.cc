// SPDX-License-Identifier: MIT
// trajlo_compare_solvers --truth: errors, and what makes them doubtful.
#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/io/trajectory_reader.h"
#include "core/io/trajectory_writer.h"
#include "core/scans/nanoseconds.h"
#include "tests/apps/command_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class CompareWithTruthTest : public ::testing::Test {
 protected:
  void SetUp() override {
    RoomRecording room;
    room.scans = 8;
    room.Write(temp_ / "in");
  }

  Outcome Call(std::vector<std::string> more, const std::string& mode = "free") const {
    more.insert(more.begin(),
                {(temp_ / "in").string(), "--output=" + (temp_ / "out").string(), "--report=false",
                 "--overwrite", "--only=gauss_newton,ceres", "--mode=" + mode});
    return CallProgram(TRAJLO_COMPARE_SOLVERS, more);
  }

  std::string Truth() const { return "--truth=" + (temp_ / "truth.tum").string(); }

  /// The result of a run is the truth, in another unit and by another clock.
  void MakeTruth(double unit, double late_s = 0.0) const {
    ASSERT_EQ(Call({}).exit_code, 0);
    TumWriter writer(temp_ / "truth.tum", IfExists::kReplace);
    for (StampedPose pose : ReadTum(temp_ / "out/free/gauss_newton/trajectory.tum", nullptr)) {
      pose.T_world_body.t *= unit;
      writer.Append(pose.t_ns + Nanoseconds(late_s), pose.T_world_body);
    }
    writer.Close();
  }

  nlohmann::json Json() const {
    return nlohmann::json::parse(ReadFile(temp_ / "out/comparison.json"));
  }

  TempFolder temp_;
};

TEST_F(CompareWithTruthTest, AGoodTruthHasNoWarnings) {
  MakeTruth(1.0);
  const Outcome outcome = Call({Truth()});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, Not(HasSubstr("warning")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("?")));
  const auto free = Json()["variants"][0]["free"];
  EXPECT_LT(free["ate_rmse_m"].get<double>(), 1e-6);
  EXPECT_EQ(free["truth_pairs"], free["poses"]);
  EXPECT_EQ(free["truth_covered_share"], 1.0);
  EXPECT_THAT(free["truth_warnings"], IsEmpty());
}

TEST_F(CompareWithTruthTest, DoubtsOfTheComparisonAreToldOnceForAllRuns) {
  MakeTruth(1000.0);
  const Outcome outcome = Call({Truth()});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("warning: all runs: the positions of the ground truth are about 1000 "
                              "times as large"),
                    HasSubstr("(trajlo_evaluate --alignment=sim3"), Not(HasSubstr("(--"))));
  EXPECT_THAT(outcome.out, HasSubstr(" ?\n"));
  const auto free = Json()["variants"][1]["free"];
  EXPECT_THAT(free["truth_warnings"].dump(), HasSubstr("times as large"));
  EXPECT_THAT(Json()["warnings"].dump(), HasSubstr("\"all runs: the positions"));
}

TEST_F(CompareWithTruthTest, AFlagIsThatOfTheProgramThatHasIt) {
  MakeTruth(1.0, 5.0);
  const Outcome outcome = Call({Truth()});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("(trajlo_evaluate --time_offset_s=5.000"));
  EXPECT_THAT(Json()["variants"][0]["free"]["truth_warnings"].dump(), HasSubstr("no pose of"));
}

TEST_F(CompareWithTruthTest, WhatIsOddAboutTheFileIsTold) {
  MakeTruth(1.0);
  std::ofstream(temp_ / "truth.tum", std::ios::app) << "1000 nan 0 0 0 0 0 1\n";
  EXPECT_THAT(Call({Truth()}).err, HasSubstr("truth.tum: line"));
  EXPECT_THAT(Json()["warnings"].dump(), HasSubstr("is not finite"));
}

TEST_F(CompareWithTruthTest, InLockstepThereIsNothingToCompareWithIt) {
  MakeTruth(1.0);
  const Outcome outcome = Call({Truth()}, "lockstep");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning: --truth is not used"));
}

TEST_F(CompareWithTruthTest, ARunWithoutPosesIsCalledSo) {
  MakeTruth(1.0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 8; ++i) {
    RoomRecording::WriteScan(RoomRecording::File(temp_ / "in", i),
                             {{nan, nan, nan, 0.0F}, {nan, nan, nan, 0.05F}});
  }
  const Outcome outcome = Call({Truth()});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("all runs: the estimate has no poses"), Not(HasSubstr("stamps"))));
}

}  // namespace
}  // namespace trajlo::testing
