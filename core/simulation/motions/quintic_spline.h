// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo::simulation {

/// A uniform B-spline of degree 5 in R⁴ (x, y, z, yaw): four times continuously differentiable, and
/// always inside the convex hull of six neighbouring control points, so that a route with clearance
/// stays free. Control point k belongs to the time t_0 + k dt; the curve is near it, not through
/// it.
class QuinticSpline {
 public:
  /// At least 6 control points. The curve is defined from t_0 + 2 dt to t_0 + (n - 3) dt, and is
  /// held at its ends outside.
  QuinticSpline(double t_0_s, double dt_s, std::vector<Eigen::Vector4d> control_points);

  Eigen::Vector4d Value(double t_s) const;
  /// Second derivative with respect to time.
  Eigen::Vector4d Acceleration(double t_s) const;

 private:
  /// The segment of `t_s` and the position in it, 0 to 1.
  std::pair<std::size_t, double> Locate(double t_s) const;

  double t_0_s_;
  double dt_s_;
  std::vector<Eigen::Vector4d> points_;
  std::vector<Eigen::Vector4d> second_differences_;  // Over dt², control points of degree 3.
};

}  // namespace trajlo::simulation
