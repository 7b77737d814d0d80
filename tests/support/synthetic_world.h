// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/scans/lidar_scan.h"
#include "manifolds/se3.h"
#include "tests/support/random_poses.h"

namespace trajlo::testing {

/// An axis-aligned box; a room is seen from inside, an obstacle from outside.
struct Box {
  Eigen::Vector3d low, high;

  /// Distance along the ray to the surface, or infinity.
  double Intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
    double enter = -std::numeric_limits<double>::infinity();
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (low[axis] - origin[axis]) / direction[axis];
      const double b = (high[axis] - origin[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave || leave <= 0.0) return std::numeric_limits<double>::infinity();
    return enter > 0.0 ? enter : leave;
  }
};

/// A small world with exact truth: a room with a few obstacles, a spinning LiDAR of `beams` rings,
/// and a pose at any time. World coordinates are those of the scene.
struct SyntheticWorld {
  std::vector<Box> boxes = {{{-9, -7, -1.5}, {11, 8, 5}},
                            {{3, 2, -1.5}, {5, 4, 1}},
                            {{-6, -5, -1.5}, {-4, -3, 3}},
                            {{6, -6, -1.5}, {8, -4, 0.5}},
                            {{-3, 5, -1.5}, {0, 6, 2}}};
  std::function<SE3(double)> T_world_body = [](double) { return SE3(); };
  int beams = 32;
  int columns = 360;
  double noise_m = 0.01;
  std::int64_t start_ns = 1'600'000'000'000'000'000;

  /// The sweep [i, i+1) · 0.1 s, streamed column by column.
  LidarScan Sweep(int i) const {
    Random random(static_cast<unsigned>(i) + 1);
    LidarScan scan;
    scan.stamp_ns = start_ns + i * 100'000'000LL;
    for (int column = 0; column < columns; ++column) {
      const std::int64_t offset_ns = 100'000'000LL * column / columns;
      const double azimuth = 2.0 * M_PI * column / columns;
      const SE3 T = T_world_body(0.1 * i + 1e-9 * static_cast<double>(offset_ns));
      for (int beam = 0; beam < beams; ++beam) {
        const double elevation = (beam - 0.5 * (beams - 1)) * (0.9 / beams);
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        double range = std::numeric_limits<double>::infinity();
        for (const Box& box : boxes) range = std::min(range, box.Intersect(T.t, T.q * ray));
        range += random.Gaussian(noise_m);
        scan.points.push_back({(range * ray).cast<float>(), 1.0F, scan.stamp_ns + offset_ns});
      }
    }
    return scan;
  }
};

}  // namespace trajlo::testing
