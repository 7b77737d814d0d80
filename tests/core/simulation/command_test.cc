// SPDX-License-Identifier: MIT
// The command as a user meets it: exit codes, messages and what is on the disk afterwards.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/process.h"
#include "tests/support/temp_folder.h"

namespace {

namespace fs = std::filesystem;

struct Outcome {
  int exit_code;
  std::string output;  // Of both streams.
};

std::string Contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class SimulateCommand : public testing::Test {
 protected:
  Outcome Run(const std::string& arguments) const {
    const std::string log = (folder_ / "log").string();
    const int status =
        std::system((TRAJLO_SIMULATE " " + arguments + " >" + log + " 2>&1").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, Contents(log)};
  }
  std::string Out(const std::string& name) const { return (folder_ / name).string(); }

  trajlo::testing::TempFolder folder_;
};

TEST_F(SimulateCommand, HelpTeachesByExample) {
  const Outcome help = Run("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.output.find("trajlo_simulate hall_os1_16 -o hall\n"), std::string::npos);
  const Outcome list = Run("--list");
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.output.find("office_os0_64"), std::string::npos);
}

TEST_F(SimulateCommand, WrongUsageExitsWithOneAndSaysWhy) {
  EXPECT_EQ(Run("").exit_code, 1);
  EXPECT_EQ(Run("--scenario=hall_os1_16").exit_code, 1);
  EXPECT_EQ(Run("--nonsense").exit_code, 1);
  EXPECT_EQ(Run("--scenario=mars --output=" + Out("a")).exit_code, 1);
  const Outcome key = Run("--scenario=hall_os1_16 --output=" + Out("a") + " --set=motion.sped=1");
  EXPECT_EQ(key.exit_code, 1);
  EXPECT_NE(key.output.find("motion.speed_mps"), std::string::npos);
  EXPECT_FALSE(fs::exists(Out("a")));
}

TEST_F(SimulateCommand, ASignalLeavesAShorterRecordingAnd130) {
  const trajlo::testing::Process process(
      {TRAJLO_SIMULATE, "hall_os1_16", "-o", Out("a"), "--duration_s=1000"});
  while (!fs::exists(folder_ / "a/scans/000002.pcd") && !process.HasEnded()) usleep(1000);
  process.Signal(SIGINT);
  EXPECT_EQ(process.Wait(), 130);
  EXPECT_NE(process.Err().find("a signal ended it early"), std::string::npos);
  const auto lines = [&](const char* name) {
    const std::string text = Contents(folder_ / "a" / name);
    return std::count(text.begin(), text.end(), '\n');
  };
  const auto scans = std::distance(fs::directory_iterator(folder_ / "a/scans"), {});
  EXPECT_EQ(lines("timestamps.txt"), scans);
  EXPECT_NEAR(static_cast<double>(lines("truth.tum")), 100.0 * static_cast<double>(scans), 2.0);
  EXPECT_TRUE(fs::exists(folder_ / "a/rig.yaml"));
}

TEST_F(SimulateCommand, WrongNumbersExitWithOneAndSayWhatIsAllowed) {
  const std::string run = "--scenario=hall_os1_16 --output=" + Out("a") + " ";
  for (const char* mistake :
       {"--duration_s=-5", "--duration_s=nan", "--duration_s=90000", "--seed=-1", "--threads=-1",
        "--set=seed=-1", "--set=lidar.columns=4294967297", "--set=lidar.range_sigma_m=nan",
        "--set=motion.speed_mps=inf", "--set=lidar0.T_body_lidar=nan,0,0,0,0,0,1",
        "--set=motion.kind=run"}) {
    const Outcome outcome = Run(run + mistake);
    EXPECT_EQ(outcome.exit_code, 1) << mistake;
    const std::string words(mistake);
    EXPECT_NE(outcome.output.find(words.substr(words.rfind('=') + 1, 3)), std::string::npos)
        << outcome.output;
  }
  EXPECT_FALSE(fs::exists(Out("a")));
  ASSERT_EQ(
      Run(run + "--duration_s=0.1 --set=lidar0.range_sigma_m=0.5,lidar0.sensor=vlp16").exit_code,
      0);
  EXPECT_NE(Contents(folder_ / "a" / "scenario.yaml").find("range_sigma_m: 0.5"),
            std::string::npos);
}

TEST_F(SimulateCommand, ARecordingWithoutAScanIsRefused) {
  const Outcome outcome = Run("hall_os1_16 --duration_s=0.05 --output=" + Out("a"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_FALSE(fs::exists(Out("a")));
}

TEST_F(SimulateCommand, AnExistingRecordingIsKeptUnlessAskedOtherwise) {
  const std::string run = "--scenario=hall_os1_16 --output=" + Out("a");
  EXPECT_EQ(Run(run + " --duration_s=0.3").exit_code, 0);
  const std::string before = Contents(folder_ / "a" / "truth.tum");
  EXPECT_EQ(Run(run + " --seed=2").exit_code, 5);
  EXPECT_EQ(Contents(folder_ / "a" / "truth.tum"), before);
  EXPECT_EQ(Run(run + " --seed=2 --duration_s=0.1 --overwrite").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "a" / "scans" / "000001.pcd"));
}

TEST_F(SimulateCommand, AnOutputThatCannotBeWrittenExitsWithFive) {
  std::ofstream(Out("file")) << "not a folder";
  const Outcome outcome = Run("--scenario=hall_os1_16 --output=" + Out("file/inside"));
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_NE(outcome.output.find("file/inside"), std::string::npos);
}

TEST_F(SimulateCommand, ABagTakesThePlaceOfTheScans) {
  const std::string run = "--scenario=hall_os1_16 --duration_s=0.2 --output=" + Out("a");
  ASSERT_EQ(Run(run).exit_code, 0);
  ASSERT_EQ(Run(run + " --format=bag --bag_layout=livox --overwrite").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "a" / "recording.bag"));
  EXPECT_FALSE(fs::exists(folder_ / "a" / "scans"));
  EXPECT_EQ(Run(run + " --format=zip").exit_code, 1);
  EXPECT_EQ(Run(run + " --bag_layout=livox").exit_code, 1);
  EXPECT_EQ(Run(run + " --format=bag --bag_layout=square").exit_code, 1);
  EXPECT_EQ(Run(run + " --format=bag --bag_compression=zip").exit_code, 1);
}

TEST_F(SimulateCommand, WhatGoesIntoNoBagIsSaidBeforeTheOldRecordingIsTouched) {
  const std::string run = "--scenario=street_kitti --duration_s=0.2 --output=" + Out("a");
  ASSERT_EQ(Run(run).exit_code, 0);
  EXPECT_EQ(Run(run + " --format=bag --overwrite").exit_code, 1);
  const Outcome early =
      Run("hall_os1_16 --duration_s=0.2 --overwrite --format=bag --output=" + Out("a") +
          " --set=start_time_ns=-300000000");
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_NE(early.output.find("before 1970"), std::string::npos) << early.output;
  EXPECT_TRUE(fs::exists(folder_ / "a" / "velodyne" / "000000.bin"));
}

TEST_F(SimulateCommand, TheNumberOfThreadsDoesNotChangeAByte) {
  const std::string run = "--scenario=faults_os1_16x2 --duration_s=0.6 ";
  ASSERT_EQ(Run(run + "--threads=1 --output=" + Out("one")).exit_code, 0);
  ASSERT_EQ(Run(run + "--threads=3 --output=" + Out("three")).exit_code, 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder_ / "one")) {
    if (!entry.is_regular_file()) continue;
    const fs::path other = folder_ / "three" / fs::relative(entry.path(), folder_ / "one");
    EXPECT_EQ(Contents(entry.path()), Contents(other)) << other;
    ++files;
  }
  EXPECT_GT(files, 10);
}

TEST_F(SimulateCommand, SettingsMayHoldCommas) {
  ASSERT_EQ(Run("--scenario=hall_os1_16 --duration_s=0.1 --output=" + Out("a") +
                " --set=lidar0.T_body_lidar=1,2,3,0,0,0,1,seed=9")
                .exit_code,
            0);
  const std::string yaml = Contents(folder_ / "a" / "scenario.yaml");
  EXPECT_NE(yaml.find("T_body_lidar: [1,2,3,0,0,0,1]"), std::string::npos);
  EXPECT_NE(yaml.find("seed: 9"), std::string::npos);
}

}  // namespace
