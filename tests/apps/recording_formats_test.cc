// SPDX-License-Identifier: MIT
// The same flight in every form of recording gives the same trajectory, to the byte.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/command_testing.h"
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
    Call(TRAJLO_RUN, {"--input=" + Path(recording), "--output=" + Path("result"),
                      "--config=" + Path(rig) + "/rig.yaml", "--overwrite", "--quiet"});
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
