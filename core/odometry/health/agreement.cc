// SPDX-License-Identifier: MIT
#include "core/odometry/health/agreement.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "core/odometry/health/support.h"

namespace trajlo {
namespace {

/// The c of MapAgreement.
constexpr double kFewPoints = 100.0;

}  // namespace

MapAgreement AgreementOf(const Window& window, const Segment& segment) {
  Eigen::Matrix3d all = kFewPoints * Eigen::Matrix3d::Identity();
  Eigen::Matrix3d on_plane = all;
  double on_map = 0.0;
  ForEachPoint(window, segment, 1, [&](const RegistrationPoint& point, bool is_on_plane) {
    const Eigen::Matrix3d nnt = point.normal_world * point.normal_world.transpose();
    all += nnt;
    if (!is_on_plane) return;
    on_plane += nnt;
    ++on_map;
  });
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> shares(on_plane, all,
                                                                         Eigen::EigenvaluesOnly);
  const auto points = static_cast<double>(segment.cloud.registration_points.size());
  return {on_map / std::max(points, 1.0), shares.eigenvalues()[0]};
}

}  // namespace trajlo
