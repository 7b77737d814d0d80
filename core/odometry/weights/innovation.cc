// SPDX-License-Identifier: MIT
#include "core/odometry/weights/innovation.h"

#include "core/odometry/window/covariance.h"
#include "core/odometry/window/window_equations.h"

namespace trajlo {

Innovation MeasureInnovation(const Window& window, const SE3& T_world_predicted) {
  WindowNormalEquations equations = AssembleWindow(window);
  const Vector6d with_points = PoseCovariance(equations, window.size()).diagonal();
  equations.H.bottomRightCorner<12, 12>() -= window.segments.back().registration.H;
  const Vector6d predicted = PoseCovariance(equations, window.size()).diagonal();
  Innovation innovation;
  innovation.correction = Minus(window.EndPose(), T_world_predicted);
  innovation.expected_variance = (predicted - with_points).cwiseMax(0.0);
  innovation.gain = innovation.expected_variance.cwiseQuotient(predicted);
  return innovation;
}

}  // namespace trajlo
