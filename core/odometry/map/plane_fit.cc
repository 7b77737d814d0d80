// SPDX-License-Identifier: MIT
#include "core/odometry/map/plane_fit.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace trajlo {
namespace {

/// Without a point of more leverage than this, the others are on a line.
constexpr double kMaxLeverage = 0.999;

/// Of the neighbours, about the nearest one: no cancellation.
struct Moments {
  Eigen::Vector3d mean;
  Eigen::Matrix3d covariance;

  explicit Moments(const Neighbors& neighbors) {
    double sx = 0, sy = 0, sz = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    const double ox = neighbors.x[0], oy = neighbors.y[0], oz = neighbors.z[0];
    for (int i = 1; i < neighbors.count; ++i) {
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
    const double inverse = 1.0 / neighbors.count;
    mean = {sx * inverse, sy * inverse, sz * inverse};
    covariance << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    covariance = covariance * inverse - mean * mean.transpose();
  }
};

/// Turns the normal to where the neighbours were seen from, if they were seen from one side.
void FindSide(const Neighbors& neighbors, FittedPlane* plane) {
  int in_front = 0, behind = 0;
  for (int i = 0; i < neighbors.count; ++i) {
    const float cosine = plane->normal_world.dot(neighbors.seen_from[i].Direction());
    in_front += cosine > SeenFrom::kPrecision ? 1 : 0;
    behind += cosine < -SeenFrom::kPrecision ? 1 : 0;
  }
  plane->is_one_sided = (in_front == 0) != (behind == 0);
  if (in_front >= behind) return;
  plane->normal_world = -plane->normal_world;
  plane->offset_m = -plane->offset_m;
}

/// l0: the root mean square of e_i / (1 - h_i). `axes` are the principal ones, of which the normal
/// is the first, and `variances` are along them.
double Thickness(const Neighbors& neighbors, const Moments& moments, const Eigen::Matrix3d& axes,
                 const Eigen::Vector3d& variances) {
  const double n = neighbors.count;
  double sum = 0.0;
  for (int i = 0; i < neighbors.count; ++i) {
    const Eigen::Vector3d from_nearest(neighbors.x[i] - neighbors.x[0],
                                       neighbors.y[i] - neighbors.y[0],
                                       neighbors.z[i] - neighbors.z[0]);
    const Eigen::Vector3d x = axes.transpose() * (from_nearest - moments.mean);
    const double leverage = (1.0 + x[1] * x[1] / variances[1] + x[2] * x[2] / variances[2]) / n;
    if (!(leverage < kMaxLeverage)) return std::numeric_limits<double>::infinity();
    const double distance_m = x[0] / (1.0 - leverage);
    sum += distance_m * distance_m;
  }
  return std::sqrt(sum / n);
}

}  // namespace

FittedPlane FitPlane(const Neighbors& neighbors, const Eigen::Vector3d& center_world,
                     const PlaneFitOptions& options, double spacing_m) {
  const int n = neighbors.count;
  if (n < PlaneFitOptions::kMinNeighbors) return {};
  const Moments moments(neighbors);
  // In floats, which suffice: a plane that is a metre wide gets up to half a millimetre of
  // thickness by rounding.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> eigen;
  eigen.computeDirect(moments.covariance.cast<float>());
  const double width_m = std::sqrt(std::max(0.0F, eigen.eigenvalues()[1]));
  if (!(width_m > 0.0) || width_m < options.min_width_in_spacings * spacing_m) return {};
  const Eigen::Matrix3d axes = eigen.eigenvectors().cast<double>();
  const Eigen::Vector3d variances = eigen.eigenvalues().cast<double>();
  const double thickness_m = Thickness(neighbors, moments, axes, variances);
  if (thickness_m > PlaneFitOptions::kMaxFlatness * width_m) return {};
  const Eigen::Vector3d normal = axes.col(0).normalized();
  const Eigen::Vector3d from_center =
      neighbors.origin_world - center_world +
      Eigen::Vector3d(neighbors.x[0], neighbors.y[0], neighbors.z[0]) + moments.mean;
  FittedPlane plane;
  plane.normal_world = normal.cast<float>();
  plane.offset_m = static_cast<float>(normal.dot(from_center));
  plane.thickness_m = static_cast<float>(thickness_m);
  plane.width_m = static_cast<float>(width_m);
  plane.normal_variance_rad2 =
      static_cast<float>(std::max(0.0, variances[0]) / (std::max(1, n - 3) * variances[1]));
  FindSide(neighbors, &plane);
  return plane;
}

}  // namespace trajlo
