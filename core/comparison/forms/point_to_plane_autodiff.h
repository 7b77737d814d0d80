// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/comparison/forms/autodiff_pose.h"
#include "factors/registration_point.h"

namespace trajlo {

/// The residual of PointToPlaneCost as a functor for ceres::AutoDiffCostFunction<..., 1, 7, 7>.
struct PointToPlaneFunctor {
  RegistrationPoint point;
  double sigma_m;

  template <typename T>
  bool operator()(const T* begin, const T* end, T* residual) const {
    const auto T_begin = autodiff::Pose<T>::FromBlock(begin);
    const auto T_end = autodiff::Pose<T>::FromBlock(end);
    const autodiff::Vec6<T> tau = (T_begin.Inverse() * T_end).Log();
    const auto phi = T_begin * autodiff::Pose<T>::Exp(T(point.alpha) * tau);
    const autodiff::Vec3<T> n = point.normal_world.cast<T>();
    residual[0] = std::sqrt(point.weight) / sigma_m *
                  (n.dot(phi * autodiff::Vec3<T>(point.p_body_m.cast<T>())) - point.offset_m);
    return true;
  }
};

}  // namespace trajlo
