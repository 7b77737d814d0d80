// SPDX-License-Identifier: MIT
#include "core/odometry/weights/fit_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

constexpr double kSigma_m = 0.09;
const RegistrationOptions kOptions;  // sigma_m 0.03, kernel_m 0.1, 1.5 spreads

void MakeLinearised(Window* window) {
  for (Segment& segment : window->segments) segment.linearization.emplace();
}

Window MakeNoisyWindow(double noise_m, double outliers = 0.0, int points_per_segment = 1000) {
  Window window = testing::MakeNoisyWindow(noise_m, outliers, points_per_segment);
  window.noise = {kSigma_m, {KernelKind::kCauchy, kOptions.kernel_m / kSigma_m}};
  MakeLinearised(&window);
  return window;
}

/// All points on a road, with normals along z, but one in `rare` on posts, with normals along a
/// direction across z; `off_m` is how far each is from its plane.
template <typename F>
Window MakeRoad(const Eigen::Vector3d& facing_world, int rare, F off_m) {
  Window window = MakeNoisyWindow(0.0);
  for (int k = 0; k < window.size(); ++k) {
    Segment& segment = window.At(k);
    int i = 0;
    for (RegistrationPoint& point : segment.points) {
      const bool is_on_post = i++ % rare == 0;
      const SE3 T = Interpolate(window.Pose(k), segment.T_world_end, point.alpha);
      point.normal_world = is_on_post ? facing_world : Eigen::Vector3d::UnitZ();
      point.offset_m = point.normal_world.dot(T * point.p_body_m) + off_m(is_on_post);
      point.axis = 0;
    }
  }
  return window;
}

double Width_m(const Window& window, std::int64_t axis) {
  return kSigma_m * window.noise.KernelOf(axis).width;
}

bool IsLinearised(const Window& window) {
  return std::all_of(window.segments.begin(), window.segments.end(),
                     [](const Segment& segment) { return segment.linearization.has_value(); });
}

TEST(FitKernel, IsSoManyStandardDeviationsOfNormalNoise) {
  for (const double noise_m : {0.03, 0.05, 0.08}) {
    Window window = MakeNoisyWindow(noise_m);
    FitKernel(kOptions, &window);
    for (const int axis : {0, 1, 2}) {
      EXPECT_NEAR(Width_m(window, axis), 1.5 * noise_m, 0.3 * noise_m) << axis;
    }
    EXPECT_FALSE(IsLinearised(window)) << "with another kernel";
  }
}

TEST(FitKernel, StaysWithinItsBounds) {
  Window window = MakeNoisyWindow(0.001);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window, 1), kOptions.sigma_m);
  window = MakeNoisyWindow(0.5);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window, 1), 3.0 * kOptions.kernel_m);
}

TEST(FitKernel, HardlyFeelsOutliersOrOneSegmentThatIsFarOff) {
  Window window = MakeNoisyWindow(0.04, 0.15);
  FitKernel(kOptions, &window);
  EXPECT_NEAR(Width_m(window, 0), 0.07, 0.01);

  window = MakeNoisyWindow(0.04);
  window.segments.back().T_world_end.t += Eigen::Vector3d(0.6, 0.5, 0.4);
  FitKernel(kOptions, &window);
  EXPECT_LT(Width_m(window, 0), 0.085);
}

// Most points are on the road and hardly scatter. Those that tell how far the car has come all say
// that it is 0.1 m farther: no outliers, however few they are.
TEST(FitKernel, FewPointsThatHoldADirectionSetItsWidth) {
  const Eigen::Vector3d forward = Eigen::Vector3d(1.0, 0.4, 0.0).normalized();
  Window window = MakeRoad(forward, 50, [](bool is_on_post) { return is_on_post ? 0.1 : 0.005; });
  FitKernel(kOptions, &window);
  std::int64_t road = -1, post = -1;
  for (const Segment& segment : window.segments) {
    for (const RegistrationPoint& point : segment.points) {
      (point.normal_world.z() > 0.5 ? road : post) = point.axis;
    }
  }
  EXPECT_NE(road, post);
  EXPECT_DOUBLE_EQ(Width_m(window, road), kOptions.sigma_m);
  EXPECT_NEAR(Width_m(window, post), 1.5 * 1.4826 * 0.1, 0.001);
  EXPECT_NEAR(window.kernel_axes.col(post).cwiseAbs().dot(forward), 1.0, 1e-6);
}

// Where all directions are held alike, the principal axes are anywhere, and others in every window.
TEST(FitKernel, TheAxesStayWhileTheyHoldTheLeast) {
  Window window = MakeNoisyWindow(0.04);
  FitKernel(kOptions, &window);
  EXPECT_EQ(window.kernel_axes, Eigen::Matrix3d::Identity());
}

// Three of five points are on coarse planes, which count little and are far off.
TEST(FitKernel, PointsCountByTheirWeight) {
  Window window = MakeNoisyWindow(0.04);
  for (Segment& segment : window.segments) {
    int i = 0;
    for (RegistrationPoint& point : segment.points) {
      if (i++ % 5 >= 3) continue;
      point.offset_m += 2.0;
      point.weight = 0.05;
    }
  }
  FitKernel(kOptions, &window);
  EXPECT_NEAR(Width_m(window, 0), 1.5 * 0.04, 0.015);
}

TEST(FitKernel, ASmallChangeKeepsTheLinearisations) {
  Window window = MakeNoisyWindow(0.04);
  FitKernel(kOptions, &window);
  const double width_m = Width_m(window, 2);
  MakeLinearised(&window);
  window.noise.widening[2] *= 1.03;
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window, 2), 1.03 * width_m);
  EXPECT_TRUE(IsLinearised(window));
}

TEST(FitKernel, IsAsItWasWhereFewPointsTellOrNobodyAsks) {
  Window window = MakeNoisyWindow(0.01, 0.0, 3);
  FitKernel(kOptions, &window);
  EXPECT_DOUBLE_EQ(Width_m(window, 0), kOptions.kernel_m);

  RegistrationOptions fixed = kOptions;
  fixed.kernel_in_spreads = 0.0;
  window = MakeNoisyWindow(0.01);
  FitKernel(fixed, &window);
  EXPECT_DOUBLE_EQ(Width_m(window, 0), kOptions.kernel_m);
}

}  // namespace
}  // namespace trajlo
