// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo::testing {

/// Reproducible draws shared by the tests.
class Random {
 public:
  explicit Random(unsigned seed = 1) : engine_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  double Gaussian(double sigma) { return sigma * std::normal_distribution<double>()(engine_); }
  Eigen::Vector3d Direction() {
    return Eigen::Vector3d(Gaussian(1), Gaussian(1), Gaussian(1)).normalized();
  }
  /// A tangent vector with the given angle in a random direction.
  Vector6d Tangent(double angle, double translation_m) {
    Vector6d tau;
    tau << translation_m * Direction(), angle * Direction();
    return tau;
  }
  SE3 Pose(double translation_m = 5.0) {
    return se3::Exp(Tangent(Uniform(0.0, 3.1), Uniform(0.0, translation_m)));
  }

 private:
  std::mt19937 engine_;
};

/// The angles at which formulas of rotations break, if they break.
inline std::vector<double> DelicateAngles() {
  return {0.0, 1e-12, 1e-9, 1e-6, 1e-3, 0.1, 0.999999, 1.0, 1.5, 3.0, M_PI - 1e-3, M_PI - 1e-9};
}

}  // namespace trajlo::testing
