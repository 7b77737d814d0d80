// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo::testing {

/// Draws shared by the tests, the same with every compiler: one that needs several draws them one
/// after the other, since C++ leaves the order open in which arguments are evaluated.
class Random {
 public:
  explicit Random(unsigned seed = 1) : engine_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double Gaussian(double sigma) { return sigma * std::normal_distribution<double>()(engine_); }
  Eigen::Vector3d Direction() {
    Eigen::Vector3d direction;
    for (double& component : direction) component = Gaussian(1);
    return direction.normalized();
  }
  /// A vector of a random direction whose length is within bounds.
  Eigen::Vector3d Vector(double shortest, double longest) {
    const double length = Uniform(shortest, longest);
    return length * Direction();
  }
  /// A place in a box about the origin.
  Eigen::Vector3d PlaceIn(const Eigen::Vector3d& half_size) {
    Eigen::Vector3d place;
    for (int i = 0; i < 3; ++i) place[i] = Uniform(-half_size[i], half_size[i]);
    return place;
  }
  /// A tangent vector with the given angle in a random direction.
  Vector6d Tangent(double angle, double translation_m) {
    Vector6d tau;
    tau.head<3>() = translation_m * Direction();
    tau.tail<3>() = angle * Direction();
    return tau;
  }
  SE3 Pose(double translation_m = 5.0) {
    const double angle = Uniform(0.0, 3.1);
    return se3::Exp(Tangent(angle, Uniform(0.0, translation_m)));
  }

 private:
  std::mt19937 engine_;
};

/// The angles at which formulas of rotations break, if they break.
inline std::vector<double> DelicateAngles() {
  return {0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.999999, 1.0, 1.5, 3.0, M_PI - 1e-3, M_PI - 1e-9};
}

}  // namespace trajlo::testing
