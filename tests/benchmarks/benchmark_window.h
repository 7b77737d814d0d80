// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/solvers/window_problem.h"
#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo {

/// A window of four segments among random planes, started centimetres off its optimum.
struct BenchmarkWindow {
  WindowProblem problem;
  std::vector<std::vector<RegistrationPoint>> storage;

  explicit BenchmarkWindow(int points_per_segment) : storage(4) {
    testing::Random random(7);
    std::vector<SE3> truth = {random.Pose()};
    const Vector6d velocity = random.Tangent(0.03, 0.06);
    for (int k = 0; k < 4; ++k) {
      truth.push_back(Plus(truth.back(), velocity));
      for (int i = 0; i < points_per_segment; ++i) {
        RegistrationPoint point;
        point.p_body_m = random.Uniform(1, 30) * random.Direction();
        point.alpha = random.Uniform(0, 1);
        point.normal_world = random.Direction();
        point.offset_m = point.normal_world.dot(Interpolate(truth[k], truth[k + 1], point.alpha) *
                                                point.p_body_m) +
                         random.Gaussian(0.02);
        storage[k].push_back(point);
      }
      problem.smoothness.push_back({velocity, Vector6d::Constant(100.0)});
    }
    for (const auto& points : storage) problem.points.push_back(&points);
    problem.prior = MakeAnchor(truth[0], 0.01, 0.01);
    problem.noise = {0.1, {KernelKind::kCauchy, 2.0}};
    for (const SE3& pose : truth) {
      problem.poses.push_back(Plus(pose, random.Tangent(0.05, 0.3)));
    }
  }
};

}  // namespace trajlo
