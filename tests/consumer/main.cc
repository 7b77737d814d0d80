// SPDX-License-Identifier: MIT
// A user's program: a LiDAR that spins and drives through a room, its odometry, and how far off it
// is.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>

#include "core/odometry/odometry.h"

/// The point of a room of 12 x 8 x 4 m that a ray from `origin` meets.
Eigen::Vector3d CastRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d half_size(6.0, 4.0, 2.0);
  double range_m = 1e9;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0.0) continue;
    range_m =
        std::fmin(range_m, (std::copysign(half_size[i], direction[i]) - origin[i]) / direction[i]);
  }
  return origin + range_m * direction;
}

Eigen::Vector3d TruePosition(double t_s) {
  return {0.8 * t_s, 0.3 * std::sin(2.0 * t_s), 0.1 * t_s};
}

int main() {
  trajlo::OdometryOptions options;
  options.threads = 2;
  trajlo::Odometry odometry(options);
  double largest_information = 0.0;
  odometry.OnPose([&](const trajlo::ControlPose&, const trajlo::Matrix6d& covariance) {
    largest_information = std::fmax(largest_information, covariance.inverse().trace());
  });
  for (int scan_index = 0; scan_index < 20; ++scan_index) {
    trajlo::LidarScan scan;
    scan.stamp_ns = scan_index * 100'000'000;
    for (int column = 0; column < 512; ++column) {
      trajlo::LidarPoint point;
      point.t_ns = scan.stamp_ns + column * 100'000'000LL / 512;
      const Eigen::Vector3d origin = TruePosition(1e-9 * static_cast<double>(point.t_ns));
      for (int ring = 0; ring < 16; ++ring) {
        const double azimuth = 2.0 * M_PI * column / 512, elevation = 0.05 * (ring - 7.5);
        const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                        std::sin(azimuth) * std::cos(elevation),
                                        std::sin(elevation));
        point.xyz_m = (CastRay(origin, direction) - origin).cast<float>();
        scan.points.push_back(point);
      }
    }
    odometry.AddScan(scan);
  }
  odometry.Finish();
  // Also uses Eigen for itself: dynamic sizes, a product that Eigen blocks and vectorises.
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(300, 300);
  const double sum = (ones * ones).sum();

  const trajlo::ControlPose& last = odometry.trajectory().poses().back();
  const Eigen::Vector3d expected = TruePosition(1e-9 * static_cast<double>(last.t_ns));
  const double error_m = (last.T_world_body.t - expected).norm();
  const Eigen::Quaterniond q = last.T_world_body.q;
  std::printf("%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f %.6e\n",
              1e-9 * static_cast<double>(last.t_ns), last.T_world_body.t.x(),
              last.T_world_body.t.y(), last.T_world_body.t.z(), q.x(), q.y(), q.z(), q.w(),
              largest_information);
  return error_m < 0.05 && sum == 27e6 && std::abs(q.norm() - 1.0) < 1e-9 ? 0 : 1;
}
