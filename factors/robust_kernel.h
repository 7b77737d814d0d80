// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/loss_function.h>

#include <cmath>

namespace trajlo {

enum class KernelKind { kNone, kHuber, kCauchy, kGemanMcClure, kTukey };

/// A robust kernel rho(s) of a squared residual s = r², with rho(0) = 0 and rho'(0) = 1 as in
/// Ceres; `width` has the unit of r. All of them are concave, so that the weight rho'(s) of
/// iteratively reweighted least squares never exceeds what the cost allows: s rho'(s) <= rho(s).
/// With a = width²:
///   none            rho = s
///   Huber           rho = s (s <= a), 2 sqrt(a s) - a beyond
///   Cauchy          rho = a log(1 + s/a)
///   Geman-McClure   rho = a s / (a + s)
///   Tukey           rho = a/3 (1 - (1 - s/a)³) (s <= a), a/3 beyond
struct RobustKernel {
  KernelKind kind = KernelKind::kCauchy;
  double width = 1.0;

  /// rho'(s) alone: what a Gauss-Newton step needs, without the logarithm of the Cauchy cost.
  double Weight(double s) const {
    const double a = width * width;
    switch (kind) {
      case KernelKind::kNone:
        return 1.0;
      case KernelKind::kHuber:
        return s <= a ? 1.0 : std::sqrt(a / s);
      case KernelKind::kCauchy:
        return a / (a + s);
      case KernelKind::kGemanMcClure:
        return (a / (a + s)) * (a / (a + s));
      case KernelKind::kTukey:
        return s <= a ? (1.0 - s / a) * (1.0 - s / a) : 0.0;
    }
    return 1.0;
  }

  double Rho(double s) const {
    const double a = width * width;
    switch (kind) {
      case KernelKind::kNone:
        return s;
      case KernelKind::kHuber:
        return s <= a ? s : 2.0 * std::sqrt(a * s) - a;
      case KernelKind::kCauchy:
        return a * std::log1p(s / a);
      case KernelKind::kGemanMcClure:
        return a * s / (a + s);
      case KernelKind::kTukey: {
        const double u = 1.0 - s / a;
        return s <= a ? a / 3.0 * (1.0 - u * u * u) : a / 3.0;
      }
    }
    return s;
  }
};

/// The same kernel as a Ceres loss, for factors with one residual per point. The second derivative
/// is reported as 0, which asks Ceres for the reweighted Gauss-Newton Hessian rho' JᵀJ; Ceres
/// itself falls back to it for every concave loss, so nothing is lost.
class RobustKernelLoss final : public ceres::LossFunction {
 public:
  explicit RobustKernelLoss(const RobustKernel& kernel) : kernel_(kernel) {}
  void Evaluate(double s, double rho[3]) const override {
    rho[0] = kernel_.Rho(s);
    rho[1] = kernel_.Weight(s);
    rho[2] = 0.0;
  }

 private:
  RobustKernel kernel_;
};

}  // namespace trajlo
