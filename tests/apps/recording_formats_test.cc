// SPDX-License-Identifier: MIT
// The same flight in every form of recording gives the same trajectory, to the byte.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/command_testing.h"
#include "tests/apps/ros2_copies.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

class RecordingFormats : public ::testing::Test {
 protected:
  std::string Path(const std::string& name) const { return (folder_ / name).string(); }

  static void Call(const char* program, std::vector<std::string> arguments,
                   const std::vector<std::string>& more = {}) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = CallProgram(program, arguments);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  void Simulate(const std::string& scenario, const std::string& name,
                const std::vector<std::string>& more) const {
    Call(TRAJLO_SIMULATE, {"--scenario=" + scenario, "--duration_s=2", "--output=" + Path(name)},
         more);
  }

  void Convert(const std::string& from, const std::string& to,
               const std::vector<std::string>& more) const {
    Call(TRAJLO_CONVERT, {Path(from), Path(to)}, more);
  }

  /// The bytes of trajectory.tum; `rig` is the recording whose rig.yaml is used.
  std::string Trajectory(const std::string& recording, const std::string& rig) const {
    const Outcome outcome =
        CallProgram(TRAJLO_RUN, {"--input=" + Path(recording), "--output=" + Path("result"),
                                 "--config=" + Path(rig) + "/rig.yaml", "--overwrite", "--quiet"});
    // 3: the stamps of many scans had to be mended.
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
    return ReadFile(Path("result") + "/trajectory.tum");
  }

  TempFolder folder_;
};

TEST_F(RecordingFormats, OneLidarAsPcdAndAsBagOfEveryLayout) {
  Simulate("hall_os1_16", "pcd", {});
  const std::string expected = Trajectory("pcd", "pcd");
  ASSERT_GT(expected.size(), 1000u);
  for (const std::string layout : {"ouster", "velodyne", "livox"}) {
    Simulate("hall_os1_16", layout,
             {"--format=bag", "--bag_layout=" + layout, "--bag_compression=lz4"});
    EXPECT_TRUE(Trajectory(layout, layout) == expected) << layout;
  }
}

TEST_F(RecordingFormats, TwoLidarsOfDifferentKindsWithTheLayoutsOfTheirDrivers) {
  Simulate("construction_site_hilti", "pcd", {});
  Simulate("construction_site_hilti", "bag", {"--format=bag"});
  const std::string expected = Trajectory("pcd", "pcd");
  ASSERT_GT(expected.size(), 1000u);
  EXPECT_TRUE(Trajectory("bag", "bag") == expected);
  EXPECT_THAT(ReadFile(Path("result/rig.yaml")), ::testing::HasSubstr("T_body_lidar"));
}

TEST_F(RecordingFormats, TwoLidarsWithBrokenStampsKeepTheOrderInWhichTheyWereRecorded) {
  // Lost scans, and stamps that repeat, jump back and jitter: four times as many as the scenario
  // has, since this is short.
  const std::vector<std::string> faults = {
      "--set=faults.duplicate_stamp_fraction=0.08,faults.backward_stamp_fraction=0.04"};
  std::vector<std::string> in_bag = faults;
  in_bag.insert(in_bag.end(), {"--format=bag", "--bag_compression=lz4"});
  Simulate("faults_os1_16x2", "pcd", faults);
  const std::string expected = Trajectory("pcd", "pcd");
  ASSERT_GT(expected.size(), 1000u);
  for (const std::string layout : {"ouster", "velodyne", "livox"}) {
    std::vector<std::string> more = in_bag;
    more.push_back("--bag_layout=" + layout);
    Simulate("faults_os1_16x2", layout, more);
    EXPECT_TRUE(Trajectory(layout, layout) == expected) << layout;
  }
  CopyToDb3(Path("ouster") + "/recording.bag", Path("ouster.db3"));
  EXPECT_TRUE(Trajectory("ouster.db3", "ouster") == expected);
  CopyToMcap(Path("ouster") + "/recording.bag", Path("ouster.mcap"));
  EXPECT_TRUE(Trajectory("ouster.mcap", "ouster") == expected);
  Convert("ouster", "scans", {});
  EXPECT_TRUE(Trajectory("scans", "pcd") == expected);
  Convert("pcd", "again.bag", {"--compression=lz4"});
  EXPECT_TRUE(Trajectory("again.bag", "ouster") == expected);
  // In the order of stamps it would be another one.
  for (const std::string folder : {"pcd/lidar0", "pcd/lidar1"}) {
    std::filesystem::remove(Path(folder) + "/record_times.txt");
  }
  EXPECT_FALSE(Trajectory("pcd", "pcd") == expected);
}

TEST_F(RecordingFormats, StampsAtTheEndOfTheSweepAreFoundByEvidenceInABag) {
  Simulate("hall_os1_16", "start", {"--format=bag"});
  Simulate("hall_os1_16", "end", {"--format=bag", "--set=faults.end_of_sweep_stamps=true"});
  EXPECT_TRUE(Trajectory("end", "end") == Trajectory("start", "start"));
}

TEST_F(RecordingFormats, ConvertingChangesNothing) {
  Simulate("hall_os1_16x2", "bag", {"--format=bag", "--set=faults.end_of_sweep_stamps=true"});
  const std::string expected = Trajectory("bag", "bag");
  Convert("bag", "copy.bag", {"--compression=lz4"});
  EXPECT_TRUE(Trajectory("copy.bag", "bag") == expected);
  Convert("bag", "livox.bag", {"--layout=livox"});
  EXPECT_TRUE(Trajectory("livox.bag", "bag") == expected);
  Convert("bag", "scans", {});
  EXPECT_TRUE(Trajectory("scans", "bag") == expected);
  // The simulator's times are such that Velodyne's seconds hold them, too.
  Convert("bag", "velodyne.bag", {"--layout=velodyne"});
  EXPECT_TRUE(Trajectory("velodyne.bag", "bag") == expected);
}

}  // namespace
}  // namespace trajlo::testing
