// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/odometry/odometry.h"
#include "core/simulation/scenario.h"
#include "core/simulation/simulator.h"

namespace trajlo::testing {

/// A simulated recording, run with the given options and the poses of its LiDARs, beside its truth.
/// `spoil` changes each scan before it is used.
struct SimulatedRun {
  std::vector<ControlPose> poses;
  std::vector<Matrix6d> covariances;
  std::vector<WindowStatistics> windows;
  std::vector<SE3> truth;  ///< Of each pose, in the frame of the first one.
  std::optional<std::int64_t> lost_at_ns;

  explicit SimulatedRun(
      const simulation::Scenario& scenario, OdometryOptions options = OdometryOptions(),
      const std::function<void(LidarScan*)>& spoil = [](LidarScan*) {}) {
    const simulation::Simulator simulator(scenario);
    for (const auto& lidar : scenario.rig) {
      options.segmenter.T_body_lidar.push_back(lidar.T_body_lidar);
    }
    Odometry odometry(options);
    odometry.OnPose([&](const ControlPose& pose, const Matrix6d& covariance) {
      poses.push_back(pose);
      covariances.push_back(covariance);
    });
    odometry.OnWindow([&](const WindowStatistics& window) { windows.push_back(window); });
    simulation::SimulateScans(simulator, 2, [&](const simulation::SimulatedScan& simulated) {
      LidarScan scan = simulated.scan;
      spoil(&scan);
      odometry.AddScan(scan);
    });
    odometry.Finish();
    lost_at_ns = odometry.lost_at_ns();
    const SE3 T_start_world = simulator.TrueWorldFromBody(poses.front().t_ns).Inverse();
    for (const ControlPose& pose : poses) {
      truth.push_back(T_start_world * simulator.TrueWorldFromBody(pose.t_ns));
    }
  }

  /// Time since the first pose.
  double Time_s(std::size_t i) const {
    return 1e-9 * static_cast<double>(poses[i].t_ns - poses.front().t_ns);
  }

  double LargestError_m() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      largest = std::max(largest, (poses[i].T_world_body.t - truth[i].t).norm());
    }
    return largest;
  }
};

}  // namespace trajlo::testing
