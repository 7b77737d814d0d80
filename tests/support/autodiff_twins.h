// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/jet.h>

#include "core/comparison/forms/autodiff_pose.h"
#include "core/comparison/forms/point_to_plane_autodiff.h"
#include "factors/white_noise_acceleration.h"
#include "manifolds/se3.h"

/// Templated twins of the factors for ceres::AutoDiffCostFunction, sharing nothing with the code
/// under test.
namespace trajlo::testing {

using PointToPlaneTwin = PointToPlaneFunctor;

struct SmoothnessTwin {
  Vector6d tau_expected, sqrt_information;
  template <typename T>
  bool operator()(const T* begin, const T* end, T* residual) const {
    Eigen::Map<autodiff::Vec6<T>> r(residual);
    r = sqrt_information.cast<T>().cwiseProduct(
        (autodiff::Pose<T>::FromBlock(begin).Inverse() * autodiff::Pose<T>::FromBlock(end)).Log() -
        tau_expected.cast<T>());
    return true;
  }
};

struct WhiteNoiseAccelerationTwin {
  WhiteNoiseAccelerationTerm term;
  template <typename T>
  bool operator()(const T* block_0, const T* block_1, const T* block_2, T* residual) const {
    using Pose = autodiff::Pose<T>;
    const Pose T_0 = Pose::FromBlock(block_0);
    const Pose T_1 = Pose::FromBlock(block_1);
    const Pose T_2 = Pose::FromBlock(block_2);
    Eigen::Map<autodiff::Vec6<T>> r(residual);
    const autodiff::Vec6<T> m = term.mean_velocity.cast<T>();
    const autodiff::Vec6<T> before = (T_0.Inverse() * T_1).Log() / T(term.first_s) - m;
    const autodiff::Vec6<T> after = (T_1.Inverse() * T_2).Log() / T(term.second_s) - m;
    r = term.sqrt_information.cast<T>().cwiseProduct(
        after - term.persistence.cast<T>().cwiseProduct(before));
    return true;
  }
};

struct PriorTwin {
  SE3 mean;
  Matrix6d S;
  Vector6d offset;
  template <typename T>
  bool operator()(const T* pose, T* residual) const {
    T block[7];
    for (int i = 0; i < 7; ++i) block[i] = T(mean.data()[i]);
    Eigen::Map<autodiff::Vec6<T>> r(residual);
    r = offset.cast<T>() + S.cast<T>() * (autodiff::Pose<T>::FromBlock(block).Inverse() *
                                          autodiff::Pose<T>::FromBlock(pose))
                                             .Log();
    return true;
  }
};

}  // namespace trajlo::testing
