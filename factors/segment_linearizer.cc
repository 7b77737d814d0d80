// SPDX-License-Identifier: MIT
#include "factors/segment_linearizer.h"

#include <utility>

#include "factors/registration_lanes.h"

namespace trajlo {

using lanes::Broadcast;
using lanes::Broadcast3;
using lanes::Cross;
using lanes::Lane4;
using lanes::Vector3;
using registration_lanes::AxisKernels;
using registration_lanes::BlockSum;
using registration_lanes::Gather;
using registration_lanes::GatheredPoints;
using registration_lanes::KernelSum;
using registration_lanes::kGroups;
using registration_lanes::kLanes;
using registration_lanes::LocatedPoints;

namespace {

/// The sums over groups of points.
struct GroupSums {
  explicit GroupSums(const AxisKernels& kernels) : cost(kernels) {}
  BlockSum H;
  Lane4 g[12] = {};
  KernelSum cost;
};

void LinearizeGroup(const GatheredPoints& points, const SegmentMotion& m, double sigma_m,
                    const AxisKernels& kernels, int group, GroupSums* sums) {
  const LocatedPoints at(points, m);
  const Lane4 information = at.weight / (sigma_m * sigma_m);
  const Lane4 s = information * at.r * at.r;
  sums->cost.Add(at.axis, s);
  const Lane4 w = information * kernels.Weight(at.axis, s);

  // v = alpha Jl(alpha tau)ᵀ j by Horner's rule in ad(tau)ᵀ, where
  // ad(tau)ᵀ [a; b] = [a x theta; a x rho + b x theta].
  const Vector3<Lane4> j1 = at.n0;
  const Vector3<Lane4> j2 = Cross(at.p0, at.n0);
  const Vector3<Lane4> rho = Broadcast3<Lane4>(m.rho);
  const Vector3<Lane4> theta = Broadcast3<Lane4>(m.theta);
  const se3::LeftJacobianCoefficients<Lane4> a(at.c);
  const Lane4 alpha = at.alpha;
  const Lane4 alpha2 = alpha * alpha;
  const Lane4 b[4] = {a.a1 * alpha, a.a2 * alpha2, a.a3 * alpha2 * alpha, a.a4 * alpha2 * alpha2};
  Vector3<Lane4> v1 = b[3] * j1;
  Vector3<Lane4> v2 = b[3] * j2;
  for (int k = 2; k >= -1; --k) {
    const Vector3<Lane4> ad1 = Cross(v1, theta);
    const Vector3<Lane4> ad2 = Cross(v1, rho) + Cross(v2, theta);
    const Lane4 factor = k >= 0 ? b[k] : Broadcast<Lane4>(1.0);
    v1 = factor * j1 + ad1;
    v2 = factor * j2 + ad2;
  }
  v1 = alpha * v1;
  v2 = alpha * v2;

  const Lane4 u[12] = {j1.x, j1.y, j1.z, j2.x, j2.y, j2.z, v1.x, v1.y, v1.z, v2.x, v2.y, v2.z};
  for (int row = 0; row < 12; ++row) {
    const Lane4 wu = w * u[row];
    sums->g[row] += wu * at.r;
    sums->H.Set(group, row, u[row], wu);
  }
}

}  // namespace

RegistrationNormalEquations LinearizedRegistration::At(const SE3& T_begin, const SE3& T_end) const {
  Vector12d xi;
  xi << Minus(T_begin, T_world_begin), Minus(T_end, T_world_end);
  const Vector12d H_xi = equations.H * xi;
  RegistrationNormalEquations shifted = equations;
  shifted.g += H_xi;
  shifted.cost += equations.g.dot(xi) + 0.5 * xi.dot(H_xi);
  return shifted;
}

SegmentLinearizer::SegmentLinearizer(const SE3& T_begin, const SE3& T_end,
                                     const RegistrationNoise& noise)
    : motion_(T_begin, T_end), noise_(noise) {}

void SegmentLinearizer::Sum::Add(const Sum& other) {
  H += other.H;
  g += other.g;
  cost += other.cost;
}

SegmentLinearizer::Sum SegmentLinearizer::Linearize(const RegistrationPoint* points,
                                                    std::size_t count) const {
  const AxisKernels kernels(noise_);
  GroupSums sums(kernels);
  int group = 0;
  for (std::size_t first = 0; first < count; first += kLanes) {
    LinearizeGroup(Gather(points + first, count - first), motion_, noise_.sigma_m, kernels, group++,
                   &sums);
    if (group < kGroups && first + kLanes < count) continue;
    sums.H.AddGroups(std::exchange(group, 0));
    sums.cost.EndBlock();
  }
  Sum sum;
  sums.H.AddTo(&sum.H);
  for (int row = 0; row < 12; ++row) {
    for (int lane = 0; lane < kLanes; ++lane) sum.g[row] += sums.g[row][lane];
  }
  sum.cost = sums.cost.Total();
  return sum;
}

double SegmentLinearizer::Cost(const RegistrationPoint* points, std::size_t count) const {
  const AxisKernels kernels(noise_);
  KernelSum cost(kernels);
  const double information = 1.0 / (noise_.sigma_m * noise_.sigma_m);
  for (std::size_t first = 0; first < count; first += kLanes) {
    const LocatedPoints at(Gather(points + first, count - first), motion_);
    cost.Add(at.axis, at.weight * information * at.r * at.r);
    cost.EndBlock();
  }
  return cost.Total();
}

RegistrationNormalEquations SegmentLinearizer::Finish(const Sum& sum) const {
  // [dr/dT_begin dr/dT_end] = [jᵀ vᵀ] B.
  Matrix12d B = Matrix12d::Identity();
  B.bottomLeftCorner<6, 6>() = -se3::LeftJacobianInverse(motion_.tau);
  B.bottomRightCorner<6, 6>() = se3::RightJacobianInverse(motion_.tau);
  RegistrationNormalEquations result;
  const Matrix12d H = sum.H.selfadjointView<Eigen::Upper>();
  result.H.noalias() = B.transpose() * H * B;
  result.g.noalias() = B.transpose() * sum.g;
  result.cost = sum.cost;
  return result;
}

RegistrationNormalEquations LinearizeSegment(const std::vector<RegistrationPoint>& points,
                                             const SE3& T_begin, const SE3& T_end,
                                             const RegistrationNoise& noise) {
  const SegmentLinearizer linearizer(T_begin, T_end, noise);
  return linearizer.Finish(linearizer.Linearize(points.data(), points.size()));
}

}  // namespace trajlo
