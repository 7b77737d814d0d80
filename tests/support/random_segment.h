// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "factors/registration_point.h"
#include "manifolds/se3_interpolation.h"
#include "tests/support/random_poses.h"

namespace trajlo::testing {

inline RegistrationPoint RandomPoint(Random* random, double alpha) {
  RegistrationPoint point;
  point.p_body_m = random->Vector(1, 40);
  point.alpha = alpha;
  point.normal_world = random->Direction();
  point.weight = random->Uniform(0.1, 1.0);
  return point;
}

/// A segment with points that lie about `spread_m` off their planes.
inline std::vector<RegistrationPoint> RandomSegment(Random* random, const SE3& begin,
                                                    const SE3& end, int count, double spread_m) {
  std::vector<RegistrationPoint> points;
  for (int i = 0; i < count; ++i) {
    const double alpha = i == 0 ? 0.0 : i == 1 ? 1.0 : random->Uniform(0, 1);
    points.push_back(RandomPoint(random, alpha));
    points.back().axis = i % 3;
    points.back().offset_m =
        points.back().normal_world.dot(Interpolate(begin, end, alpha) * points.back().p_body_m) +
        random->Gaussian(spread_m);
  }
  return points;
}

}  // namespace trajlo::testing
