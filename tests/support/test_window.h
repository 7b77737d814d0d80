// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "core/odometry/window/window.h"
#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo::testing {

/// A window of segments of 0.03 s in a room of random planes, started a little off the truth:
/// a known velocity for the first segment, white-noise acceleration for the others.
inline Window MakeTestWindow(unsigned seed, int points_per_segment = 300, int segments = 4) {
  constexpr double kInterval_s = 0.03;
  Random random(seed);
  std::vector<SE3> truth = {random.Pose()};
  const Vector6d velocity = random.Tangent(0.05, 0.1);
  Window window;
  window.prior = MakeAnchor(Plus(truth[0], random.Tangent(0.001, 0.002)), 0.01, 0.01);
  window.noise = {0.1, {KernelKind::kCauchy, 2.0}, {1.0, 1.5, 0.7}};
  window.T_world_begin = Plus(truth[0], random.Tangent(0.01, 0.03));
  for (int k = 0; k < segments; ++k) {
    truth.push_back(Plus(truth.back(), velocity + random.Tangent(0.002, 0.003)));
    Segment segment;
    segment.cloud.begin_ns = 30'000'000LL * k;
    segment.cloud.end_ns = 30'000'000LL * (k + 1);
    segment.T_world_end = Plus(truth.back(), random.Tangent(0.01, 0.03));
    segment.cloud.registration_points.resize(100);
    segment.bend_m2 = 5e-5 * k;  // Up to 2.5 points share an error.
    if (k == 0) {
      segment.motion = SmoothnessTerm{velocity, Vector6d::Constant(100.0)};
    } else {
      segment.motion =
          WhiteNoiseAccelerationTerm(Vector6d::Constant(5.0), kInterval_s, kInterval_s);
    }
    for (int i = 0; i < points_per_segment; ++i) {
      RegistrationPoint point;
      point.p_body_m = random.Vector(1, 20);
      point.alpha = random.Uniform(0, 1);
      point.normal_world = random.Direction();
      point.axis = i % 3;
      const double outlier = random.Uniform(0, 1) < 0.1 ? random.Uniform(-1, 1) : 0.0;
      const SE3 T = Interpolate(truth[truth.size() - 2], truth.back(), point.alpha);
      point.offset_m = point.normal_world.dot(T * point.p_body_m) + random.Gaussian(0.02) + outlier;
      segment.points.push_back(point);
    }
    window.segments.push_back(std::move(segment));
  }
  return window;
}

/// The same window, whose points are off their planes by noise of `noise_m` at its poses, and a
/// share `outliers` of them by a metre.
inline Window MakeNoisyWindow(double noise_m, double outliers = 0.0,
                              int points_per_segment = 1000) {
  Window window = MakeTestWindow(1, points_per_segment);
  Random random(2);
  for (int k = 0; k < window.size(); ++k) {
    Segment& segment = window.At(k);
    for (RegistrationPoint& point : segment.points) {
      const SE3 T = Interpolate(window.Pose(k), segment.T_world_end, point.alpha);
      const double off_m = random.Uniform(0, 1) < outliers ? 1.0 : random.Gaussian(noise_m);
      point.offset_m = point.normal_world.dot(T * point.p_body_m) + off_m;
    }
  }
  return window;
}

/// The largest component of the differences between poses.
inline double LargestDifference(const std::vector<SE3>& a, const std::vector<SE3>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, Minus(a[i], b[i]).cwiseAbs().maxCoeff());
  }
  return largest;
}

}  // namespace trajlo::testing
