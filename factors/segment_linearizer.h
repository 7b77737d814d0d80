// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "factors/registration_point.h"
#include "factors/robust_kernel.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;

/// How a point-to-plane distance is weighed: s = weight (r / sigma)², cost ½ rho(s).
struct RegistrationNoise {
  double sigma_m = 0.1;
  /// Its width is in units of sigma: a kernel of c metres has width c / sigma.
  RobustKernel kernel{};
  /// How many times as wide the kernel is for the points of each RegistrationPoint::axis.
  std::array<double, 3> widening = {1.0, 1.0, 1.0};

  RobustKernel KernelOf(std::size_t axis) const {
    return {kernel.kind, kernel.width * widening[axis]};
  }
  /// That of points of which each `points` share an error, and count as one.
  RegistrationNoise SharedBy(double points) const {
    const double factor = std::sqrt(points);
    return {sigma_m * factor, {kernel.kind, kernel.width / factor}, widening};
  }
};

/// The registration cost of one segment around a state: E(xi) ~ cost + gᵀxi + ½ xiᵀH xi with
/// xi = [xi_begin; xi_end] the right perturbations of the two control poses.
struct RegistrationNormalEquations {
  Matrix12d H = Matrix12d::Zero();
  Vector12d g = Vector12d::Zero();
  double cost = 0.0;  ///< ½ sum rho(s_i), exact.
};

/// The registration of a segment, and where it was linearised.
struct LinearizedRegistration {
  SE3 T_world_begin, T_world_end;
  RegistrationNormalEquations equations;

  /// The registration xi = [T_begin ⊖ T_world_begin; T_end ⊖ T_world_end] away from there, to first
  /// order and with the same kernel weights: g + H xi, cost + gᵀxi + ½ xiᵀH xi.
  RegistrationNormalEquations At(const SE3& T_begin, const SE3& T_end) const;
};

/// Evaluates PointToPlaneCost for all points of a segment in one pass.
///
/// Instead of two 6x6 interpolation Jacobians per point, everything happens in the begin frame,
/// where the derivatives c and d of the paper factor into a part of the point and a part of the
/// segment:
///
///   p0 = Exp(alpha tau) p,  n0 = R_beginᵀ n,  j = [n0; p0 x n0],  v = alpha Jl(alpha tau)ᵀ j
///   dr/dT_begin = jᵀ - vᵀ Jl⁻¹(tau),   dr/dT_end = vᵀ Jr⁻¹(tau)
///
/// (Adj(Exp(-alpha tau)) Jl(alpha tau) = Jr(alpha tau), and moving both poses by one world
/// perturbation moves the interpolated pose by it). So H and g are summed over u = [j; v] and
/// turned into pose coordinates once, exactly.
class SegmentLinearizer {
 public:
  SegmentLinearizer(const SE3& T_begin, const SE3& T_end, const RegistrationNoise& noise);

  /// Sums over [j; v]; sums of disjoint point ranges may be added, in a fixed order where results
  /// must not depend on threads.
  struct Sum {
    Matrix12d H = Matrix12d::Zero();  ///< Upper triangle only.
    Vector12d g = Vector12d::Zero();
    double cost = 0.0;
    void Add(const Sum& other);
  };

  Sum Linearize(const RegistrationPoint* points, std::size_t count) const;
  double Cost(const RegistrationPoint* points, std::size_t count) const;

  /// Turns a sum over [j; v] into the normal equations of [xi_begin; xi_end].
  RegistrationNormalEquations Finish(const Sum& sum) const;

 private:
  SegmentMotion motion_;
  RegistrationNoise noise_;
};

/// The normal equations of a whole segment, on the calling thread.
RegistrationNormalEquations LinearizeSegment(const std::vector<RegistrationPoint>& points,
                                             const SE3& T_begin, const SE3& T_end,
                                             const RegistrationNoise& noise);

}  // namespace trajlo
