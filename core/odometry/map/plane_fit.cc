// SPDX-License-Identifier: MIT
#include "core/odometry/map/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace trajlo {

bool FitPlane(const Neighbors& neighbors, const PlaneFitOptions& options, double spacing_m,
              Plane* plane) {
  const int n = neighbors.count;
  if (n < options.min_neighbors) return false;
  double sx = 0, sy = 0, sz = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  // Moments about the nearest neighbour: no cancellation.
  const double ox = neighbors.x[0], oy = neighbors.y[0], oz = neighbors.z[0];
  for (int i = 1; i < n; ++i) {
    const double x = neighbors.x[i] - ox, y = neighbors.y[i] - oy, z = neighbors.z[i] - oz;
    sx += x;
    sy += y;
    sz += z;
    xx += x * x;
    xy += x * y;
    xz += x * z;
    yy += y * y;
    yz += y * z;
    zz += z * z;
  }
  const double inverse = 1.0 / n;
  const Eigen::Vector3d mean(sx * inverse, sy * inverse, sz * inverse);
  Eigen::Matrix3d covariance;
  covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  covariance = covariance * inverse - mean * mean.transpose();

  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(covariance);
  plane->thickness_m = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]));
  plane->width_m = std::sqrt(std::max(0.0, eigen.eigenvalues()[1]));
  if (plane->width_m < options.min_width_in_spacings * spacing_m ||
      plane->thickness_m > options.max_thickness_m ||
      plane->thickness_m > options.max_flatness * plane->width_m) {
    return false;
  }
  const double relative = plane->thickness_m / options.half_weight_thickness_m;
  plane->weight = 1.0 / (1.0 + relative * relative);
  plane->normal_world = eigen.eigenvectors().col(0);
  plane->offset_m =
      plane->normal_world.dot(neighbors.origin_world + Eigen::Vector3d(ox, oy, oz) + mean);
  return true;
}

}  // namespace trajlo
