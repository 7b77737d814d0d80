// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/evaluation/association.h"
#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"

namespace trajlo::testing {

/// A smooth motion through three dimensions that never repeats itself, turning on the way.
inline Eigen::Affine3d SmoothPose(double t_s) {
  return Eigen::Translation3d(5.0 * std::sin(0.7 * t_s), 4.0 * std::sin(1.1 * t_s + 0.4),
                              1.5 * std::sin(1.7 * t_s + 1.0)) *
         Eigen::AngleAxisd(0.5 * t_s, Eigen::Vector3d(1.0, 2.0, 3.0).normalized());
}

/// SmoothPose at even times; stamps begin at `begin_s` plus `clock_s`, what the clock is ahead.
inline TimedPoses SmoothPoses(double begin_s, double step_s, std::size_t count,
                              double clock_s = 0.0) {
  TimedPoses poses;
  for (std::size_t i = 0; i < count; ++i) {
    const double t_s = begin_s + step_s * static_cast<double>(i);
    poses.t_ns.push_back(Nanoseconds(t_s + clock_s));
    poses.T_world_body.push_back(SmoothPose(t_s));
  }
  return poses;
}

/// Poses without rotation on a line along x, one a second, at the given places.
inline TimedPoses OnALine(const std::vector<double>& x_m) {
  TimedPoses poses;
  for (std::size_t i = 0; i < x_m.size(); ++i) {
    poses.t_ns.push_back(Nanoseconds(static_cast<double>(i)));
    poses.T_world_body.emplace_back(Eigen::Translation3d(x_m[i], 0.0, 0.0));
  }
  return poses;
}

}  // namespace trajlo::testing
