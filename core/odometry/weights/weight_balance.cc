// SPDX-License-Identifier: MIT
#include "core/odometry/weights/weight_balance.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace trajlo {

void WeightBalance::Group::Remember(double decay, double new_squares, double new_redundancy) {
  squares = decay * squares + new_squares;
  redundancy = decay * redundancy + new_redundancy;
}

void WeightBalance::Update(const WindowProblem& problem,
                           const std::vector<RegistrationNormalEquations>& registration,
                           double duration_s) {
  WindowNormalEquations window;
  AssembleWindow(problem, problem.poses, registration, &window);
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(window.H);
  if (ldlt.info() != Eigen::Success || !(ldlt.vectorD().minCoeff() > 0.0)) return;
  const Eigen::MatrixXd covariance =
      ldlt.solve(Eigen::MatrixXd::Identity(window.H.rows(), window.H.cols()));

  double points = 0.0, registration_used = 0.0;
  double squares[2] = {0.0, 0.0}, used[2] = {0.0, 0.0};
  for (int k = 0; k < problem.segments(); ++k) {
    const Eigen::Matrix<double, 12, 12> C = covariance.block<12, 12>(6 * k, 6 * k);
    for (const RegistrationPoint& point : *problem.points[k]) points += point.weight;
    registration_used += C.cwiseProduct(registration[k].H).sum();
    const SmoothnessTerm& term = problem.smoothness[k];
    const SmoothnessTerm::Linearization smooth =
        term.Linearize(problem.poses[k], problem.poses[k + 1], problem.LinearizationPoint(k));
    Eigen::Matrix<double, 6, 12> J;
    J << smooth.wrt_begin, smooth.wrt_end;
    const Vector6d variance = (J * C * J.transpose()).diagonal();
    for (int part = 0; part < 2; ++part) {
      // Back to configured sigmas: the present factor is part of the term's information.
      const double factor = part == 0 ? translation_.factor : rotation_.factor;
      squares[part] += factor * factor * smooth.residual.segment<3>(3 * part).squaredNorm();
      used[part] += variance.segment<3>(3 * part).sum();
    }
  }
  const double decay = std::exp(-duration_s / options_.memory_s);
  const double components = 3.0 * problem.segments();
  registration_.Remember(decay, 2.0 * window.cost.registration,
                         std::max(points - registration_used, 0.0));
  translation_.Remember(decay, squares[0], std::max(components - used[0], 0.0));
  rotation_.Remember(decay, squares[1], std::max(components - used[1], 0.0));
  if (!(registration_.redundancy > 0.0) || !(registration_.squares > 0.0)) return;
  const double registration_variance =
      options_.points_per_error * registration_.squares / registration_.redundancy;
  const double components_per_s = components / duration_s;
  SetFactor(registration_variance, components_per_s, &translation_);
  SetFactor(registration_variance, components_per_s, &rotation_);
}

void WeightBalance::SetFactor(double registration_variance, double redundancy_per_s,
                              Group* group) const {
  const double prior = options_.prior_s * redundancy_per_s;
  const double variance = (group->squares + prior * registration_variance) /
                          (group->redundancy + prior) / registration_variance;
  group->factor = std::clamp(std::sqrt(variance), 1.0 / options_.max_factor, options_.max_factor);
}

}  // namespace trajlo
