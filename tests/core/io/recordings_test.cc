// SPDX-License-Identifier: MIT
// Real recordings are understood without any option. They are not part of the repository.
#include <gmock/gmock.h>

#include "core/io/scan_folder.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {
namespace {

struct Recording {
  const char* folder;
  std::size_t scans;
  bool point_times;
  std::int64_t first_stamp_ns;
  double longest_sweep_s;
};

void PrintTo(const Recording& recording, std::ostream* out) { *out << recording.folder; }

class RealRecording : public ::testing::TestWithParam<Recording> {};

TEST_P(RealRecording, IsUnderstoodWithoutOptions) {
  const Recording& expected = GetParam();
  const std::filesystem::path path = DataDir() / expected.folder;
  if (!std::filesystem::is_directory(path)) {
    GTEST_SKIP() << "no recording at " << path << "; set TRAJLO_DATA to the folder that holds it";
  }
  ScanFolder recording(path);
  EXPECT_EQ(recording.size(), expected.scans);
  EXPECT_EQ(recording.time_convention().HasPointTimes(), expected.point_times);
  std::size_t scans = 0;
  for (LidarScan scan; recording.Next(&scan); ++scans) {
    if (scans == 0) {
      EXPECT_EQ(scan.stamp_ns, expected.first_stamp_ns);
    }
    EXPECT_EQ(scan.has_point_times, expected.point_times);
    EXPECT_GT(scan.points.size(), 4000U);
    for (const LidarPoint& point : scan.points) {
      ASSERT_TRUE(point.xyz_m.allFinite());
      ASSERT_GE(point.t_ns, scan.stamp_ns);
      ASSERT_LE(static_cast<double>(point.t_ns - scan.stamp_ns), 1e9 * expected.longest_sweep_s);
    }
  }
  EXPECT_EQ(scans, expected.scans);
  EXPECT_FALSE(recording.report().IsPartial());
  if (expected.point_times) {
    EXPECT_EQ(recording.time_convention().unit, TimeUnit::kSeconds);
    EXPECT_EQ(recording.time_convention().origin, TimeOrigin::kSweepStart);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Folders, RealRecording,
    ::testing::Values(Recording{"kitti_raw_0005", 24, true, 1317042000000000000, 0.1036},
                      Recording{"hdl32e_cart", 12, true, 1500000000100085735, 0.1001},
                      Recording{"vlp16_static", 14, true, 1584002666163101196, 0.1},
                      Recording{"newer_college_06", 3, true, 0, 0.1006},
                      Recording{"kitti_bin", 4, false, 0, 0.0}),
    [](const auto& param) { return std::string(param.param.folder); });

}  // namespace
}  // namespace trajlo
