// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>
#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "manifolds/se3_manifold.h"

namespace trajlo::testing {

/// The tangent Jacobian (rows x 6) of one pose block of a Ceres factor.
inline Eigen::MatrixXd TangentJacobian(const ceres::CostFunction& factor,
                                       const std::vector<SE3>& poses, int block) {
  std::vector<const double*> parameters;
  std::vector<std::vector<double>> storage;
  std::vector<double*> jacobians;
  for (const SE3& pose : poses) parameters.push_back(pose.data());
  for (size_t i = 0; i < poses.size(); ++i) storage.emplace_back(7 * factor.num_residuals());
  for (auto& values : storage) jacobians.push_back(values.data());
  Eigen::VectorXd residuals(factor.num_residuals());
  EXPECT_TRUE(factor.Evaluate(parameters.data(), residuals.data(), jacobians.data()));
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>>(
             jacobians[block], factor.num_residuals(), 7) *
         Se3PlusJacobian(poses[block]);
}

/// What is the same whether Jacobians are asked for or not. Factors whose residuals are a root of
/// normal equations need not take that root for a cost alone.
enum class NullForms { kGiveTheResiduals, kGiveTheCost };

/// Both null forms of the Jacobian call must work: no Jacobians at all, and those of one block.
inline void ExpectNullJacobianFormsWork(const ceres::CostFunction& factor,
                                        const std::vector<SE3>& poses,
                                        NullForms forms = NullForms::kGiveTheResiduals) {
  std::vector<const double*> parameters;
  for (const SE3& pose : poses) parameters.push_back(pose.data());
  Eigen::VectorXd none(factor.num_residuals()), some(factor.num_residuals());
  EXPECT_TRUE(factor.Evaluate(parameters.data(), none.data(), nullptr));
  for (size_t wanted = 0; wanted < poses.size(); ++wanted) {
    std::vector<double> storage(7 * factor.num_residuals(), 0.0);
    std::vector<double*> jacobians(poses.size(), nullptr);
    jacobians[wanted] = storage.data();
    EXPECT_TRUE(factor.Evaluate(parameters.data(), some.data(), jacobians.data()));
    EXPECT_NEAR(none.norm(), some.norm(), 1e-9 * (1.0 + none.norm()));
    if (forms == NullForms::kGiveTheCost) continue;
    EXPECT_LT((none - some).norm(), 1e-9 * (1.0 + none.norm()));
  }
}

/// The analytic Jacobians against Ceres's numeric ones, on the manifold.
inline void ExpectJacobiansMatchNumericOnes(const ceres::CostFunction& factor,
                                            const std::vector<SE3>& poses, double tolerance) {
  SE3Manifold manifold;
  const std::vector<const ceres::Manifold*> manifolds(poses.size(), &manifold);
  ceres::NumericDiffOptions options;
  ceres::GradientChecker checker(&factor, &manifolds, options);
  std::vector<const double*> parameters;
  for (const SE3& pose : poses) parameters.push_back(pose.data());
  ceres::GradientChecker::ProbeResults results;
  EXPECT_TRUE(checker.Probe(parameters.data(), tolerance, &results)) << results.error_log;
}

}  // namespace trajlo::testing
