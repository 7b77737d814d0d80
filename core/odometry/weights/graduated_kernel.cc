// SPDX-License-Identifier: MIT
#include "core/odometry/weights/graduated_kernel.h"

#include "core/odometry/segments/choose_evenly.h"
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
/// About this many points are asked.
constexpr std::size_t kAsked = 128;

}  // namespace

GraduatedKernel::GraduatedKernel(const Window& window, double kernel_m) : reach_(Matrix6d::Zero()) {
  if (window.noise.kernel.kind == KernelKind::kNone) return;
  const Matrix6d covariance = PoseCovariance(AssembleWindow(window), window.size());
  if (!covariance.allFinite()) return;
  reach_ = kStandardDeviations * kStandardDeviations / (kernel_m * kernel_m) * covariance;
}

bool GraduatedKernel::Widen(Segment* newest) {
  std::vector<RegistrationPoint>& points = newest->points;
  const Eigen::Matrix3d R_end_world = newest->T_world_end.q.conjugate().toRotationMatrix();
  const auto f = [&](const RegistrationPoint& point) {
    // The segment is short: the point's place at its end.
    const Eigen::Vector3d normal = R_end_world * point.normal_world;
    Vector6d J;
    J << normal, point.p_body_m.cross(normal);
    return J.dot(reach_ * J);
  };
  // What most points say, some of them say, too.
  const std::size_t stride = StrideForAbout(kAsked, points.size());
  std::size_t asked = 0, far = 0;
  for (std::size_t i = 0; i < points.size(); i += stride, ++asked) {
    far += f(points[i]) >= kSmallest ? 1 : 0;
  }
  if (2 * far <= asked) {
    reach_.setZero();
    return false;
  }
  weights_.clear();
  for (RegistrationPoint& point : points) {
    weights_.push_back(point.weight);
    const double coarseness = point.coarseness;
    point.weight *= coarseness * coarseness * coarseness / (1.0 + f(point));
  }
  reach_ *= kShrink;
  newest->linearization.reset();
  return true;
}

void GraduatedKernel::Restore(Segment* newest) const {
  for (std::size_t i = 0; i < weights_.size(); ++i) newest->points[i].weight = weights_[i];
  newest->linearization.reset();
}

}  // namespace trajlo
