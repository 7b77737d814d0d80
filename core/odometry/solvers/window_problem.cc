// SPDX-License-Identifier: MIT
#include "core/odometry/solvers/window_problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "factors/square_root.h"

namespace trajlo {

WindowCost CostWithoutRegistration(const WindowProblem& problem) {
  WindowCost cost;
  cost.prior = 0.5 * problem.prior.Residual(problem.poses[0]).squaredNorm();
  for (int k = 0; k < problem.segments(); ++k) {
    cost.smoothness +=
        0.5 * problem.smoothness[k].Residual(problem.poses[k], problem.poses[k + 1]).squaredNorm();
  }
  return cost;
}

void RegistrationEvaluator::Evaluate(const WindowProblem& problem, const std::vector<SE3>& poses,
                                     bool jacobians,
                                     std::vector<RegistrationNormalEquations>* equations) {
  constexpr std::size_t kChunk = 256;
  const int segments = problem.segments();
  std::vector<SegmentLinearizer> linearizers;
  linearizers.reserve(static_cast<std::size_t>(segments));
  chunks_.clear();
  for (int k = 0; k < segments; ++k) {
    linearizers.emplace_back(poses[k], poses[k + 1], problem.noise, problem.LinearizationPoint(k));
    const std::size_t count = problem.points[k]->size();
    for (std::size_t first = 0; first < count; first += kChunk) {
      chunks_.push_back({k, first, std::min(kChunk, count - first), {}});
    }
  }
  threads_->ParallelFor(chunks_.size(), [&](std::size_t i) {
    Chunk& chunk = chunks_[i];
    const RegistrationPoint* points = problem.points[chunk.segment]->data() + chunk.first;
    const SegmentLinearizer& linearizer = linearizers[chunk.segment];
    if (jacobians) {
      chunk.sum = linearizer.Linearize(points, chunk.count);
    } else {
      chunk.sum.cost = linearizer.Cost(points, chunk.count);
    }
  });
  std::vector<SegmentLinearizer::Sum> sums(static_cast<std::size_t>(segments));
  for (const Chunk& chunk : chunks_) sums[chunk.segment].Add(chunk.sum);
  equations->resize(static_cast<std::size_t>(segments));
  for (int k = 0; k < segments; ++k) {
    if (jacobians) {
      (*equations)[k] = linearizers[k].Finish(sums[k]);
    } else {
      (*equations)[k] = {};
      (*equations)[k].cost = sums[k].cost;
    }
  }
}

void AssembleWindow(const WindowProblem& problem, const std::vector<SE3>& poses,
                    const std::vector<RegistrationNormalEquations>& registration,
                    WindowNormalEquations* window) {
  const int size = 6 * static_cast<int>(poses.size());
  window->H.setZero(size, size);
  window->g.setZero(size);
  window->cost = {};
  for (int k = 0; k < problem.segments(); ++k) {
    const SmoothnessTerm::Linearization smooth =
        problem.smoothness[k].Linearize(poses[k], poses[k + 1], problem.LinearizationPoint(k));
    Eigen::Matrix<double, 6, 12> J;
    J << smooth.wrt_begin, smooth.wrt_end;
    window->H.block<12, 12>(6 * k, 6 * k) += registration[k].H + J.transpose() * J;
    window->g.segment<12>(6 * k) += registration[k].g + J.transpose() * smooth.residual;
    window->cost.registration += registration[k].cost;
    window->cost.smoothness += 0.5 * smooth.residual.squaredNorm();
  }
  const Vector6d r = problem.prior.Residual(poses[0]);
  const Matrix6d J = problem.prior.Jacobian(poses[0], problem.first_estimate_jacobians);
  window->H.topLeftCorner<6, 6>() += J.transpose() * J;
  window->g.head<6>() += J.transpose() * r;
  window->cost.prior = 0.5 * r.squaredNorm();
}

Matrix6d FirstPoseCovariance(const WindowNormalEquations& window) {
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(window.H);
  const Eigen::VectorXd pivots = ldlt.vectorD();
  if (ldlt.info() != Eigen::Success || !(pivots.minCoeff() > 1e-14 * pivots.maxCoeff())) {
    return Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(window.H.rows(), 6);
  first.topRows<6>().setIdentity();
  const Matrix6d covariance = ldlt.solve(first).topRows<6>();
  return 0.5 * (covariance + covariance.transpose());
}

MarginalizationPrior MarginalizeOldest(const WindowProblem& problem,
                                       const RegistrationNormalEquations& first_segment,
                                       bool use_qr) {
  const SE3& leaving = problem.poses[0];
  const SE3& staying = problem.poses[1];
  const SmoothnessTerm::Linearization smooth =
      problem.smoothness[0].Linearize(leaving, staying, problem.LinearizationPoint(0));
  const Vector6d prior_residual = problem.prior.Residual(leaving);
  const Matrix6d prior_J = problem.prior.Jacobian(leaving, problem.first_estimate_jacobians);
  if (use_qr) {
    const SquareRoot<12> registration = MakeSquareRoot<12>(first_segment.H, first_segment.g);
    Eigen::Matrix<double, Eigen::Dynamic, 12> J(24, 12);
    Eigen::VectorXd r(24);
    J << registration.S, smooth.wrt_begin, smooth.wrt_end, prior_J, Matrix6d::Zero();
    r << registration.s, smooth.residual, prior_residual;
    return MarginalizeQr(J, r, staying);
  }
  Eigen::Matrix<double, 6, 12> J;
  J << smooth.wrt_begin, smooth.wrt_end;
  Matrix12d H = first_segment.H + J.transpose() * J;
  Vector12d g = first_segment.g + J.transpose() * smooth.residual;
  H.topLeftCorner<6, 6>() += prior_J.transpose() * prior_J;
  g.head<6>() += prior_J.transpose() * prior_residual;
  return MarginalizeSchur(H, g, staying);
}

WindowCondition ConditionOf(const WindowProblem& problem,
                            const std::vector<RegistrationNormalEquations>& registration) {
  const SE3& newest = problem.poses.back();
  Matrix6d information = Matrix6d::Zero();
  std::size_t points = 0;
  for (int k = 0; k < problem.segments(); ++k) {
    // A rigid motion xi of the newest frame moves T_j by Adj(T_j⁻¹ T_newest) xi.
    Eigen::Matrix<double, 12, 6> A;
    A << se3::Adjoint(problem.poses[k].Inverse() * newest),
        se3::Adjoint(problem.poses[k + 1].Inverse() * newest);
    information += A.transpose() * registration[k].H * A;
    points += problem.points[k]->size();
  }
  WindowCondition condition;
  const double translation = information.topLeftCorner<3, 3>().trace();
  const double rotation = information.bottomRightCorner<3, 3>().trace();
  if (points == 0 || !(translation > 0.0) || !(rotation > 0.0)) return condition;
  const double scale = std::sqrt(translation / rotation);
  Vector6d scaling = Vector6d::Ones();
  scaling.tail<3>().setConstant(scale);
  const double sigma = problem.noise.sigma_m;
  information = scaling.asDiagonal() * information * scaling.asDiagonal();
  information *= sigma * sigma / static_cast<double>(points);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  condition.smallest_eigenvalue = eigen.eigenvalues()[0];
  condition.weak_direction = eigen.eigenvectors().col(0);
  return condition;
}

}  // namespace trajlo
