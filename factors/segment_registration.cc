// SPDX-License-Identifier: MIT
#include "factors/segment_registration.h"

#include <algorithm>
#include <cmath>

#include "factors/square_root.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {

bool PreparedRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                        double** jacobians) const {
  Eigen::Map<Eigen::Matrix<double, 13, 1>> r(residuals);
  if (jacobians == nullptr) {
    r.setZero();
    r[12] = std::sqrt(std::max(0.0, 2.0 * equations_->cost));
    return std::isfinite(equations_->cost);
  }
  const SquareRoot<12> root = MakeSquareRoot<12>(equations_->H, equations_->g);
  r.head<12>() = root.s;
  r[12] = std::sqrt(std::max(0.0, 2.0 * equations_->cost - root.s.squaredNorm()));
  Eigen::Matrix<double, 13, 12> J;
  J << root.S, Eigen::Matrix<double, 1, 12>::Zero();
  const SE3 T[2] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1])};
  WriteJacobians(T, J, jacobians);
  return std::isfinite(equations_->cost);
}

bool SegmentRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                       double** jacobians) const {
  const bool is_known = last_ &&
                        std::equal(parameters[0], parameters[0] + 7, last_->T_world_begin.data()) &&
                        std::equal(parameters[1], parameters[1] + 7, last_->T_world_end.data());
  if (!is_known) {
    const SE3 T_begin = SE3::FromData(parameters[0]);
    const SE3 T_end = SE3::FromData(parameters[1]);
    last_ = {T_begin, T_end, LinearizeSegment(*points_, T_begin, T_end, noise_)};
  }
  return PreparedRegistrationCost(&last_->equations).Evaluate(parameters, residuals, jacobians);
}

}  // namespace trajlo
