// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/jet.h>

#include "factors/autodiff_pose.h"
#include "factors/point_to_plane_autodiff.h"
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
