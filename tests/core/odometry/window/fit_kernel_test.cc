// SPDX-License-Identifier: MIT
#include "core/odometry/window/fit_kernel.h"

#include <gtest/gtest.h>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

constexpr double kSigma_m = 0.09;
const RegistrationOptions kOptions;  // sigma_m 0.03, kernel_m 0.1, 3 spreads

Window MakeNoisyWindow(double noise_m, double outliers = 0.0, int points_per_segment = 1000) {
  Window window = testing::MakeNoisyWindow(noise_m, outliers, points_per_segment);
  window.noise = {kSigma_m, {KernelKind::kCauchy, kOptions.kernel_m / kSigma_m}};
  for (Segment& segment : window.segments) segment.linearization.emplace();
  return window;
}

double Width_m(const Window& window) { return kSigma_m * window.noise.kernel.width; }

bool IsLinearised(const Window& window) {
  return std::all_of(window.segments.begin(), window.segments.end(),
                     [](const Segment& segment) { return segment.linearization.has_value(); });
}

TEST(FitKernel, IsThreeStandardDeviationsOfNormalNoise) {
  for (const double noise_m : {0.015, 0.02, 0.025}) {
    Window window = MakeNoisyWindow(noise_m);
    FitKernel(kOptions, &window);
    EXPECT_NEAR(Width_m(window), 3.0 * noise_m, 0.3 * noise_m);
    EXPECT_FALSE(IsLinearised(window)) << "with another kernel";
  }
}

TEST(FitKernel, StaysWithinItsBounds) {
  Window window = MakeNoisyWindow(0.001);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window), kOptions.sigma_m);
  window = MakeNoisyWindow(0.5);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window), kOptions.kernel_m);
}

TEST(FitKernel, HardlyFeelsOutliersOrOneSegmentThatIsFarOff) {
  Window window = MakeNoisyWindow(0.02, 0.15);
  FitKernel(kOptions, &window);
  EXPECT_NEAR(Width_m(window), 0.07, 0.01);

  window = MakeNoisyWindow(0.02);
  window.segments.back().T_world_end.t += Eigen::Vector3d(0.6, 0.5, 0.4);
  FitKernel(kOptions, &window);
  EXPECT_LT(Width_m(window), 0.085);
}

TEST(FitKernel, DistancesCountByTheirWeight) {
  Window window = MakeNoisyWindow(0.04);
  for (Segment& segment : window.segments) {
    for (RegistrationPoint& point : segment.points) point.weight = 0.25;
  }
  FitKernel(kOptions, &window);
  EXPECT_NEAR(Width_m(window), 0.06, 0.006);
}

TEST(FitKernel, ASmallChangeKeepsTheLinearisations) {
  Window window = MakeNoisyWindow(0.02);
  FitKernel(kOptions, &window);
  const double width_m = Width_m(window);
  for (Segment& segment : window.segments) segment.linearization.emplace();
  window.noise.kernel.width *= 1.03;
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window), 1.03 * width_m);
  EXPECT_TRUE(IsLinearised(window));
}

TEST(FitKernel, IsAsWideAsItMayBeWhereFewPointsTellOrNobodyAsks) {
  Window window = MakeNoisyWindow(0.01, 0.0, 4);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window), kOptions.kernel_m);
  EXPECT_TRUE(IsLinearised(window));

  RegistrationOptions fixed = kOptions;
  fixed.kernel_in_spreads = 0.0;
  window = MakeNoisyWindow(0.01);
  FitKernel(fixed, &window);
  EXPECT_DOUBLE_EQ(Width_m(window), kOptions.kernel_m);
}

}  // namespace
}  // namespace trajlo
