// SPDX-License-Identifier: MIT
#include "factors/segment_linearizer.h"

#include <algorithm>

#include "factors/registration_lanes.h"

namespace trajlo {

using lanes::At;
using lanes::Broadcast;
using lanes::Broadcast3;
using lanes::Cross;
using lanes::kLanes;
using lanes::Lane4;
using lanes::Vector3;
using registration_lanes::BlockSum;
using registration_lanes::GatheredPoints;
using registration_lanes::KernelSum;
using registration_lanes::kGroups;
using registration_lanes::LocatedPoints;

SegmentLinearizer::SegmentLinearizer(const SE3& T_begin, const SE3& T_end,
                                     const RegistrationNoise& noise)
    : motion_(T_begin, T_end), noise_(noise) {}

void SegmentLinearizer::Sum::Add(const Sum& other) {
  H += other.H;
  g += other.g;
  cost += other.cost;
}

template <typename T>
struct SegmentLinearizer::Lanes {
  explicit Lanes(const RobustKernel& kernel) : cost(kernel) {}
  BlockSum<T> H;
  T g[12] = {};
  KernelSum<T> cost;
};

template <typename T>
void SegmentLinearizer::LinearizeLanes(const RegistrationPoint* points, int group,
                                       Lanes<T>* sums) const {
  const SegmentMotion& m = motion_;
  const LocatedPoints<T> at(GatheredPoints<T>(points), m);
  const T information = at.weight / (noise_.sigma_m * noise_.sigma_m);
  const T w = information * sums->cost.AddAndWeigh(information * at.r * at.r);

  // v = alpha Jl(alpha tau)ᵀ j by Horner's rule in ad(tau)ᵀ [a; b] = [a x theta; a x rho + b x
  // theta].
  const Vector3<T> j1 = at.n0;
  const Vector3<T> j2 = Cross(at.p0, at.n0);
  const Vector3<T> rho = Broadcast3<T>(m.rho);
  const Vector3<T> theta = Broadcast3<T>(m.theta);
  const se3::LeftJacobianCoefficients<T> a(at.c);
  const T alpha = at.alpha;
  const T alpha2 = alpha * alpha;
  const T b[4] = {a.a1 * alpha, a.a2 * alpha2, a.a3 * alpha2 * alpha, a.a4 * alpha2 * alpha2};
  Vector3<T> v1 = b[3] * j1;
  Vector3<T> v2 = b[3] * j2;
  for (int k = 2; k >= -1; --k) {
    const Vector3<T> ad1 = Cross(v1, theta);
    const Vector3<T> ad2 = Cross(v1, rho) + Cross(v2, theta);
    const T factor = k >= 0 ? b[k] : Broadcast<T>(1.0);
    v1 = factor * j1 + ad1;
    v2 = factor * j2 + ad2;
  }
  v1 = alpha * v1;
  v2 = alpha * v2;

  const T u[12] = {j1.x, j1.y, j1.z, j2.x, j2.y, j2.z, v1.x, v1.y, v1.z, v2.x, v2.y, v2.z};
  for (int row = 0; row < 12; ++row) {
    const T wu = w * u[row];
    sums->g[row] += wu * at.r;
    sums->H.Set(group, row, u[row], wu);
  }
}

template <typename T>
void SegmentLinearizer::RunLinearize(const RegistrationPoint* points, size_t count,
                                     Sum* sum) const {
  Lanes<T> lanes(noise_.kernel);
  for (size_t first = 0; first < count; first += kGroups * kLanes<T>) {
    const auto groups = static_cast<int>(std::min<size_t>(kGroups, (count - first) / kLanes<T>));
    for (int g = 0; g < groups; ++g) {
      LinearizeLanes<T>(points + first + g * kLanes<T>, g, &lanes);
    }
    lanes.H.AddGroups(groups);
    lanes.cost.EndBlock();
  }
  lanes.H.AddTo(&sum->H);
  for (int row = 0; row < 12; ++row) {
    for (int lane = 0; lane < kLanes<T>; ++lane) sum->g[row] += At(lanes.g[row], lane);
  }
  sum->cost += lanes.cost.Total();
}

template <typename T>
double SegmentLinearizer::RunCost(const RegistrationPoint* points, size_t count) const {
  KernelSum<T> cost(noise_.kernel);
  const double information = 1.0 / (noise_.sigma_m * noise_.sigma_m);
  for (size_t i = 0; i < count; i += kLanes<T>) {
    const LocatedPoints<T> at(GatheredPoints<T>(points + i), motion_);
    cost.Add(at.weight * information * at.r * at.r);
    cost.EndBlock();
  }
  return cost.Total();
}

/// How many of the points go side by side: the series of the Stumpff functions, which the lanes
/// use, hold for rotations below 1 rad.
size_t SegmentLinearizer::Vectorised(size_t count) const {
  return motion_.angle_squared < 1.0 ? count / 4 * 4 : 0;
}

SegmentLinearizer::Sum SegmentLinearizer::Linearize(const RegistrationPoint* points,
                                                    size_t count) const {
  Sum sum;
  const size_t vectorised = Vectorised(count);
  RunLinearize<Lane4>(points, vectorised, &sum);
  RunLinearize<double>(points + vectorised, count - vectorised, &sum);
  return sum;
}

double SegmentLinearizer::Cost(const RegistrationPoint* points, size_t count) const {
  const size_t vectorised = Vectorised(count);
  return RunCost<Lane4>(points, vectorised) +
         RunCost<double>(points + vectorised, count - vectorised);
}

RegistrationNormalEquations SegmentLinearizer::Finish(const Sum& sum) const {
  const SegmentMotion& m = motion_;
  // [dr/dT_begin dr/dT_end] = [jᵀ vᵀ] B.
  Matrix12d B = Matrix12d::Identity();
  B.bottomLeftCorner<6, 6>() = -se3::LeftJacobianInverse(m.tau);
  B.bottomRightCorner<6, 6>() = se3::RightJacobianInverse(m.tau);
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
