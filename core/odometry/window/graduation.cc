// SPDX-License-Identifier: MIT
#include "core/odometry/window/graduation.h"

#include <algorithm>

#include "core/odometry/window/covariance.h"
#include "core/odometry/window/window_equations.h"

namespace trajlo {
namespace {

/// Of the prediction.
constexpr double kStandardDeviations = 3.0;
/// Of the variance, from round to round.
constexpr double kShrink = 0.25;
/// Where f of most points is below this, the kernel itself reaches far enough.
constexpr double kSmallest = 1.0;

}  // namespace

Graduation::Graduation(const Window& window) : reach_(Matrix6d::Zero()) {
  if (window.noise.kernel.kind == KernelKind::kNone) return;
  const double kernel_m = window.noise.kernel.width * window.noise.sigma_m;
  const Matrix6d covariance = PoseCovariance(AssembleWindow(window), window.size());
  if (!covariance.allFinite()) return;
  reach_ = kStandardDeviations * kStandardDeviations / (kernel_m * kernel_m) * covariance;
}

bool Graduation::Widen(Segment* newest) {
  std::vector<double> f;
  f.reserve(newest->points.size());
  for (const RegistrationPoint& point : newest->points) {
    // The segment is short: the point's place at its end.
    const Eigen::Vector3d normal = newest->T_world_end.q.conjugate() * point.normal_world;
    Vector6d J;
    J << normal, point.p_body_m.cross(normal);
    f.push_back(J.dot(reach_ * J));
  }
  reach_ *= kShrink;
  const auto is_far = [](double f_of_point) { return f_of_point >= kSmallest; };
  if (2 * std::count_if(f.begin(), f.end(), is_far) <= static_cast<std::ptrdiff_t>(f.size())) {
    return false;
  }
  weights_.clear();
  for (std::size_t i = 0; i < f.size(); ++i) {
    weights_.push_back(newest->points[i].weight);
    newest->points[i].weight /= 1.0 + f[i];
  }
  newest->linearization.reset();
  return true;
}

void Graduation::Restore(Segment* newest) const {
  for (std::size_t i = 0; i < weights_.size(); ++i) newest->points[i].weight = weights_[i];
  newest->linearization.reset();
}

}  // namespace trajlo
