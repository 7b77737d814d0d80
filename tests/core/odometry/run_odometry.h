// SPDX-License-Identifier: MIT
// The odometry in a small world that is known, and how far it is off there.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

#include "core/odometry/odometry.h"
#include "tests/support/synthetic_world.h"

namespace trajlo::testing {

inline OdometryOptions RoomOptions() {
  OdometryOptions options;
  options.segmenter.registration_voxel_m = 0.5;
  return options;
}

/// At rest for half a second, then ever faster on a bent path, with a turn.
inline SE3 StartsAtRest(double t) {
  const double s = std::max(0.0, t - 0.5);
  const double way = s * s * s / (1.0 + s * s);
  Vector6d tau;
  tau << 0.8 * way, 0.2 * way, 0.1 * std::sin(way), 0.05 * std::sin(2 * way), 0, 0.4 * way;
  return se3::Exp(tau);
}

/// A constant twist, which linear interpolation represents exactly: 1.5 m/s and 0.6 rad/s.
inline SE3 ConstantTwist(double t) {
  Vector6d twist;
  twist << 1.4, 0.5, 0.1, 0.1, 0.0, 0.6;
  return se3::Exp(t * twist);
}

struct RunResult {
  std::unique_ptr<Odometry> odometry;
  std::vector<WindowStatistics> windows;
};

inline RunResult RunOn(const SyntheticWorld& world, const OdometryOptions& options, int sweeps,
                       const std::function<void(int, LidarScan*)>& change = {}) {
  RunResult run;
  run.odometry = std::make_unique<Odometry>(options);
  run.odometry->OnWindow([&](const WindowStatistics& w) { run.windows.push_back(w); });
  for (int i = 0; i < sweeps; ++i) {
    LidarScan scan = world.Sweep(i);
    if (change) change(i, &scan);
    run.odometry->AddScan(scan);
  }
  run.odometry->Finish();
  return run;
}

/// Largest position error against the truth, in the frame of the first pose.
inline double LargestError(const SyntheticWorld& world, const Trajectory& trajectory,
                           double until_s) {
  const SE3 T_start = world.T_world_body(0.0);
  double largest = 0.0;
  for (const ControlPose& pose : trajectory.poses()) {
    const double t = 1e-9 * static_cast<double>(pose.t_ns - world.start_ns);
    if (t > until_s) break;
    const SE3 truth = T_start.Inverse() * world.T_world_body(t);
    largest = std::max(largest, (truth.t - pose.T_world_body.t).norm());
  }
  return largest;
}

inline void ExpectFinite(const Trajectory& trajectory) {
  ASSERT_FALSE(trajectory.empty());
  for (const ControlPose& pose : trajectory.poses()) ASSERT_TRUE(pose.T_world_body.IsFinite());
}

}  // namespace trajlo::testing
