// SPDX-License-Identifier: MIT
// What the whole process holds, in a program of its own: a leak anywhere in the estimator shows.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "core/odometry/odometry.h"
#include "tests/support/sanitizers.h"
#include "tests/support/synthetic_world.h"

namespace trajlo {
namespace {

constexpr int kSweepsOfALap = 30;

/// A closed loop through the room, with a turn of the head, once in three seconds.
SE3 Loop(double t) {
  const double phase = 2.0 * M_PI * t / (0.1 * kSweepsOfALap);
  return SE3(so3::Exp({0.0, 0.0, 0.4 * std::sin(phase)}),
             {1.0 - std::cos(phase), 0.5 * (1.0 - std::cos(2.0 * phase)), 0.0});
}

/// Resident memory of this process without what malloc keeps for later.
double Resident_MB() {
  malloc_trim(0);
  std::ifstream statm("/proc/self/statm");
  double total_pages = 0.0, resident_pages = 0.0;
  statm >> total_pages >> resident_pages;
  EXPECT_GT(resident_pages, 0.0);
  return 1e-6 * resident_pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TEST(OdometryMemory, LapsOfTheSameLoopAddNothing) {
  if (testing::kSanitized) GTEST_SKIP() << "sanitizers keep memory that was freed";
  testing::SyntheticWorld world;
  world.T_world_body = Loop;
  world.beams = 16;
  world.columns = 180;
  OdometryOptions options;
  options.segmenter.registration_voxel_m = 0.5;
  Odometry odometry(options);
  const auto drive = [&](int first_lap, int laps) {
    for (int i = first_lap * kSweepsOfALap; i < (first_lap + laps) * kSweepsOfALap; ++i) {
      odometry.AddScan(world.Sweep(i));
    }
  };
  drive(0, 2);
  const double before_MB = Resident_MB();
  const std::size_t points_before = odometry.map().finest().size();
  constexpr int kLaps = 6;
  drive(2, kLaps);
  const double growth_MB = Resident_MB() - before_MB;
  ASSERT_FALSE(odometry.lost_at_ns());
  EXPECT_LT(static_cast<double>(odometry.map().finest().size()),
            1.3 * static_cast<double>(points_before));
  // A tenth of what the points of the scans would take.
  constexpr double kScans_MB = 1e-6 * kLaps * kSweepsOfALap * 16 * 180 * sizeof(LidarPoint);
  EXPECT_LT(growth_MB, 0.1 * kScans_MB);
}

}  // namespace
}  // namespace trajlo
