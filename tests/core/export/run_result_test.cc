// SPDX-License-Identifier: MIT
#include "core/export/run_result.h"

#include <gmock/gmock.h>

#include "core/io/errors.h"
#include "core/io/rig_yaml.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using ::testing::HasSubstr;

std::string Summary(const std::string& exit_code, const std::string& lost_at) {
  return R"({"exit": {"code": )" + exit_code +
         R"(}, "input": {"paths": ["room"], "scans": {"read": 7}}, "result": {"lost_at_s": )" +
         lost_at + "}}";
}

class Result : public ::testing::Test {
 protected:
  Result() {
    WriteFile(folder_ / "run.json", Summary("0", "null"));
    WriteFile(folder_ / "config.yaml", "expert: {segmenter: {max_gap_s: 2.5}}\n");
    WriteFile(
        folder_ / "trajectory.tum",
        "1.000000001 0 0 0 0 0 0 1\n1.1 1 0 0 0 0 0 1\n1.2 2 0 0 0 0 0 1\n1.3 3 0 0 0 0 0 1\n");
    WriteFile(folder_ / "windows.csv", "index,end_s,flags\n0,1.1,0\n1,1.2,8\n2,1.3,40\n");
  }
  std::string MessageOf(const ResultOptions& options = {}) const {
    try {
      ReadRunResult(folder_.path(), options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  TempFolder folder_;
};

TEST_F(Result, IsReadWithTimesToTheNanosecondAndFlags) {
  ASSERT_TRUE(IsRunResult(folder_.path()));
  const RunResult result = ReadRunResult(folder_.path());
  ASSERT_EQ(result.trajectory.poses().size(), 4u);
  EXPECT_EQ(result.trajectory.poses()[0].t_ns, 1'000'000'001);
  EXPECT_EQ(result.trajectory.poses()[2].flags, 8u);
  EXPECT_EQ(result.trajectory.poses()[3].T_world_body.t.x(), 3.0);
  EXPECT_EQ(result.inputs, std::vector<std::string>{"room"});
  EXPECT_EQ(result.config.odometry.segmenter.max_gap_s, 2.5);
  EXPECT_EQ(result.scans_read, 7u);
  EXPECT_TRUE(result.has_control_poses);
  EXPECT_TRUE(result.covariances.empty());
}

TEST_F(Result, NamesTheRecordingWhereItWasIfItIsStillThere) {
  const std::string there = (folder_ / "room").string();
  WriteFile(folder_ / "run.json",
            R"({"exit": {"code": 0}, "input": {"paths": ["room"], "absolute_paths": [")" + there +
                R"("], "scans": {"read": 7}}, "result": {"lost_at_s": null}})");
  EXPECT_EQ(ReadRunResult(folder_.path()).inputs, std::vector<std::string>{"room"});
  std::filesystem::create_directory(there);
  EXPECT_EQ(ReadRunResult(folder_.path()).inputs, std::vector<std::string>{there});
}

TEST_F(Result, SaysWhatItsRunSaysAgainstIt) {
  EXPECT_EQ(RunShortcoming(folder_.path()), "");
  const auto ended = [&](const std::string& exit) {
    WriteFile(folder_ / "run.json", R"({"exit": )" + exit + "}");
    return RunShortcoming(folder_.path());
  };
  EXPECT_EQ(ended(R"({"code": 0, "reason": "ok", "message": ""})"), "");
  EXPECT_EQ(ended(R"({"code": 4, "reason": "lost", "message": "lost at 3 s"})"), "lost at 3 s");
  EXPECT_THAT(ended(R"({"code": null, "reason": "running", "message": ""})"), HasSubstr("killed"));
  EXPECT_EQ(ended("7"), "");
}

TEST_F(Result, ExtrinsicsThatWereFoundReplaceThoseThatWereGiven) {
  WriteFile(folder_ / "config.yaml", RigYaml("given", {SE3(), SE3()}));
  EXPECT_EQ(ReadRunResult(folder_.path()).config.odometry.segmenter.T_body_lidar[1].t.x(), 0.0);
  WriteFile(folder_ / "rig.yaml",
            RigYaml("found", {SE3(), SE3(Eigen::Quaterniond::Identity(), {0.01, 0, 0})}));
  EXPECT_EQ(ReadRunResult(folder_.path()).config.odometry.segmenter.T_body_lidar[1].t.x(), 0.01);
}

TEST_F(Result, PosesFromWhereItGotLostAreLeftOutUnlessTheyAreWanted) {
  WriteFile(folder_ / "run.json", Summary("4", "\"1.200000000\""));
  const RunResult result = ReadRunResult(folder_.path());
  EXPECT_EQ(result.trajectory.poses().size(), 2u);
  EXPECT_EQ(result.poses_left_out, 2u);
  EXPECT_EQ(ReadRunResult(folder_.path(), {true}).trajectory.poses().size(), 4u);
  WriteFile(folder_ / "run.json", Summary("4", "\"0.5\""));
  EXPECT_THAT(MessageOf(), HasSubstr("--keep_lost"));
}

TEST_F(Result, AnInterruptedRunDoesNotKnowHowManyScansThereAre) {
  WriteFile(folder_ / "run.json", Summary("130", "null"));
  EXPECT_FALSE(ReadRunResult(folder_.path()).scans_read);
  WriteFile(folder_ / "run.json", Summary("null", "null"));  // Killed.
  EXPECT_FALSE(ReadRunResult(folder_.path()).scans_read);
}

TEST_F(Result, PosesAtOtherTimesThanTheWindowsAreNoticed) {
  WriteFile(folder_ / "trajectory.tum", "1.05 0 0 0 0 0 0 1\n1.15 1 0 0 0 0 0 1\n");
  EXPECT_FALSE(ReadRunResult(folder_.path()).has_control_poses);
  // Too short for a window, as the run may have been: nothing says so.
  WriteFile(folder_ / "windows.csv", "index,end_s,flags\n");
  EXPECT_TRUE(ReadRunResult(folder_.path()).has_control_poses);
}

TEST_F(Result, CovariancesAreSymmetric) {
  std::string names = "t_s", values = "1.1";
  const char* const axes[] = {"rho_x", "rho_y", "rho_z", "theta_x", "theta_y", "theta_z"};
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      names += std::string(",") + axes[i] + "__" + axes[j];
      values += "," + std::to_string(10 * i + j);
    }
  }
  WriteFile(folder_ / "covariance.csv", names + "\n" + values + "\n");
  const RunResult result = ReadRunResult(folder_.path());
  const Matrix6d& covariance = result.covariances.at(1'100'000'000);
  EXPECT_EQ(covariance(1, 4), 14.0);
  EXPECT_EQ(covariance(4, 1), 14.0);
  EXPECT_EQ(covariance(5, 5), 55.0);
}

TEST_F(Result, BrokenFilesAreNamedWithTheirLines) {
  WriteFile(folder_ / "windows.csv", "index,end_s,flags\n0,1.1,0\n1,later,8\n");
  EXPECT_THAT(MessageOf(),
              AllOf(HasSubstr("windows.csv"), HasSubstr("line 3"), HasSubstr("end_s")));
  WriteFile(folder_ / "windows.csv", "index,begin_s\n0,1.1\n");
  EXPECT_THAT(MessageOf(), HasSubstr("no column 'end_s'"));
  WriteFile(folder_ / "windows.csv", "");
  EXPECT_THAT(MessageOf(), HasSubstr("no column 'end_s'"));
  WriteFile(folder_ / "run.json", "{");
  EXPECT_THAT(MessageOf(), HasSubstr("run.json"));
  std::filesystem::remove(folder_ / "run.json");
  EXPECT_FALSE(IsRunResult(folder_.path()));
}

TEST_F(Result, PosesMustFollowEachOther) {
  WriteFile(folder_ / "trajectory.tum", "1.2 0 0 0 0 0 0 1\n1.1 1 0 0 0 0 0 1\n");
  EXPECT_THAT(MessageOf(), HasSubstr("does not come after"));
}

}  // namespace
}  // namespace trajlo::testing
