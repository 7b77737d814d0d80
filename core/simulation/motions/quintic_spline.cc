// SPDX-License-Identifier: MIT
#include "core/simulation/motions/quintic_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trajlo::simulation {

using Eigen::Vector4d;

namespace {

/// De Boor's recursion on uniform knots: degree + 1 control points from `points`, u in [0, 1].
template <int kDegree>
Vector4d DeBoor(const Vector4d* points, double u) {
  std::array<Vector4d, kDegree + 1> d;
  std::copy(points, points + kDegree + 1, d.begin());
  for (int r = 1; r <= kDegree; ++r) {
    for (int j = kDegree; j >= r; --j) {
      const double alpha = (u + kDegree - j) / (kDegree + 1 - r);
      const auto index = static_cast<std::size_t>(j);
      d[index] = (1.0 - alpha) * d[index - 1] + alpha * d[index];
    }
  }
  return d[kDegree];
}

}  // namespace

QuinticSpline::QuinticSpline(double t_0_s, double dt_s, std::vector<Vector4d> control_points)
    : t_0_s_(t_0_s), dt_s_(dt_s), points_(std::move(control_points)) {
  if (points_.size() < 6) throw std::invalid_argument("a quintic spline needs 6 control points");
  for (std::size_t i = 0; i + 2 < points_.size(); ++i) {
    second_differences_.emplace_back((points_[i + 2] - 2.0 * points_[i + 1] + points_[i]) /
                                     (dt_s * dt_s));
  }
}

std::pair<std::size_t, double> QuinticSpline::Locate(double t_s) const {
  const double last = static_cast<double>(points_.size()) - 5.0;
  const double x = std::clamp((t_s - t_0_s_) / dt_s_ - 2.0, 0.0, last);
  const double segment = std::min(std::floor(x), last - 1.0);
  return {static_cast<std::size_t>(segment), x - segment};
}

Vector4d QuinticSpline::Value(double t_s) const {
  const auto [segment, u] = Locate(t_s);
  return DeBoor<5>(&points_[segment], u);
}

Vector4d QuinticSpline::Acceleration(double t_s) const {
  const auto [segment, u] = Locate(t_s);
  return DeBoor<3>(&second_differences_[segment], u);
}

}  // namespace trajlo::simulation
