// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/test_window.h"

namespace trajlo {

/// A window of four segments among random planes, started centimetres off its optimum.
inline Window MakeBenchmarkWindow(int points_per_segment) {
  Window window = testing::MakeTestWindow(7, points_per_segment);
  testing::Random random(8);
  std::vector<SE3> poses = window.Poses();
  for (SE3& pose : poses) pose = Plus(pose, random.Tangent(0.05, 0.3));
  window.SetPoses(poses);
  return window;
}

}  // namespace trajlo
