// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/odometry/window/window.h"
#include "core/odometry/window/window_equations.h"

namespace trajlo {

/// The factor of one point, at the poses of its window:
///
///   s = weight (distance / sigma)²,   cost ½ rho(s),   H += information JᵀJ,   J = ∂distance/∂xi.
struct PointFactor {
  RegistrationPoint point;
  int segment = 0;             ///< Between poses `segment` and `segment` + 1.
  std::int64_t t_ns = 0;       ///< When it was measured.
  Eigen::Vector3d x_world;     ///< Where it is by then, m.
  double distance_m = 0.0;     ///< nᵀx - d.
  double kernel_weight = 0.0;  ///< rho'(s), in [0, 1].
  double information = 0.0;    ///< weight rho'(s) / sigma², 1/m².
};

/// The points of one segment.
struct SegmentFactors {
  int points = 0;
  double sigma_m = 0.0;                 ///< Of each, with what they share: Window::NoiseOf().
  std::array<double, 3> kernel_m = {};  ///< Width of the kernel along each of the kernel axes.
  RegistrationNormalEquations registration;
};

/// The residuals of the marginalisation prior, and their Jacobian over its poses.
struct PriorFactor {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};

/// All that is minimised in a window, evaluated exactly at its poses: every factor, and what they
/// add up to. Nothing is taken over from the solver, so this also shows how exactly it has solved:
/// at a minimum, g is zero.
struct WindowGraph {
  std::vector<SegmentFactors> segments;
  std::vector<PointFactor> points;       ///< By segment, in the order of Segment::points.
  std::vector<LinearizedMotion> motion;  ///< One for each segment; count 0 where there is none.
  PriorFactor prior;
  WindowNormalEquations equations;  ///< The sum of all of them: H, g, and cost by kind.
};

WindowGraph MakeWindowGraph(const Window& window);

}  // namespace trajlo
