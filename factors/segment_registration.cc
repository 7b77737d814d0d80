// SPDX-License-Identifier: MIT
#include "factors/segment_registration.h"

#include <algorithm>
#include <cmath>

#include "factors/square_root.h"
#include "manifolds/lanes.h"
#include "manifolds/se3_manifold.h"

namespace trajlo {

using lanes::At;
using lanes::Broadcast;
using lanes::Broadcast3;
using lanes::Cross;
using lanes::Dot;
using lanes::kLanes;
using lanes::Lane4;
using lanes::RotateInverse;
using lanes::Vector3;

namespace {

/// Gathers one member of up to four points.
template <typename T>
struct GatheredPoints {
  Vector3<T> p, n;
  T alpha, offset, weight;

  explicit GatheredPoints(const RegistrationPoint* const* points) {
    for (int i = 0; i < kLanes<T>; ++i) {
      const RegistrationPoint& point = *points[i];
      At(p.x, i) = point.p_body_m.x();
      At(p.y, i) = point.p_body_m.y();
      At(p.z, i) = point.p_body_m.z();
      At(n.x, i) = point.normal_world.x();
      At(n.y, i) = point.normal_world.y();
      At(n.z, i) = point.normal_world.z();
      At(alpha, i) = point.alpha;
      At(offset, i) = point.offset_m;
      At(weight, i) = point.weight;
    }
  }
};

/// The sum of ½ rho(s_i). For Cauchy, a/2 log prod (1 + s_i/a): one logarithm for many points.
class KernelCost {
 public:
  explicit KernelCost(const RobustKernel& kernel)
      : kernel_(kernel), inverse_a_(1.0 / (kernel.width * kernel.width)) {}

  void Add(double s) {
    if (kernel_.kind != KernelKind::kCauchy) {
      sum_ += kernel_.Rho(s);
      return;
    }
    product_ *= 1.0 + s * inverse_a_;
    if (product_ > 1e100) Flush();
  }

  double Total() {
    if (kernel_.kind == KernelKind::kCauchy) Flush();
    return 0.5 * sum_;
  }

 private:
  void Flush() {
    sum_ += std::log(product_) / inverse_a_;
    product_ = 1.0;
  }

  RobustKernel kernel_;
  double inverse_a_;
  double product_ = 1.0;
  double sum_ = 0.0;
};

}  // namespace

SegmentLinearizer::SegmentLinearizer(const SE3& T_begin, const SE3& T_end,
                                     const RegistrationNoise& noise)
    : motion_(T_begin, T_end), noise_(noise) {}

void SegmentLinearizer::Sum::Add(const Sum& other) {
  H += other.H;
  g += other.g;
  cost += other.cost;
}

/// Per lane: the upper triangle of H by rows, and g.
template <typename T>
struct SegmentLinearizer::Lanes {
  T H[78] = {};
  T g[12] = {};
  KernelCost cost;
};

namespace {

template <typename T>
StumpffSeries<T> StumpffOf(const T& s) {
  return StumpffSeries<T>(s);
}
template <>
StumpffSeries<double> StumpffOf<double>(const double& s) {
  return Stumpff(s);
}

}  // namespace

template <typename T>
T SegmentLinearizer::Residual(const RegistrationPoint* const* points) const {
  const GatheredPoints<T> in(points);
  const SegmentMotion& m = motion_;
  const StumpffSeries<T> c = StumpffOf<T>(in.alpha * in.alpha * m.angle_squared);
  const Vector3<T> p0 = m.MoveToBegin<T>(in.alpha, c, in.p);
  const Vector3<T> n0 = RotateInverse(m.R_begin, in.n);
  return Dot(n0, p0) + (Dot(in.n, Broadcast3<T>(m.t_begin)) - in.offset);
}

template <typename T>
void SegmentLinearizer::LinearizeLanes(const RegistrationPoint* const* points,
                                       Lanes<T>* sums) const {
  const GatheredPoints<T> in(points);
  const T alpha = in.alpha;
  const SegmentMotion& m = motion_;
  const StumpffSeries<T> c = StumpffOf<T>(alpha * alpha * m.angle_squared);
  const Vector3<T> p0 = m.MoveToBegin<T>(alpha, c, in.p);
  const Vector3<T> n0 = RotateInverse(m.R_begin, in.n);
  const T r = Dot(n0, p0) + (Dot(in.n, Broadcast3<T>(m.t_begin)) - in.offset);

  const double information = 1.0 / (noise_.sigma_m * noise_.sigma_m);
  T s = in.weight * information * r * r;
  T w;
  for (int i = 0; i < kLanes<T>; ++i) {
    sums->cost.Add(At(s, i));
    At(w, i) = noise_.kernel.Weight(At(s, i));
  }
  w = w * in.weight * information;

  // v = alpha Jl(alpha tau)ᵀ j by Horner's rule in ad(tau)ᵀ [a; b] = [a x theta; a x rho + b x
  // theta].
  const Vector3<T> j1 = n0;
  const Vector3<T> j2 = Cross(p0, n0);
  const Vector3<T> rho = Broadcast3<T>(m.rho);
  const Vector3<T> theta = Broadcast3<T>(m.theta);
  const se3::LeftJacobianCoefficients<T> a(c);
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
  int index = 0;
  for (int row = 0; row < 12; ++row) {
    const T wu = w * u[row];
    sums->g[row] += wu * r;
    for (int column = row; column < 12; ++column) sums->H[index++] += wu * u[column];
  }
}

template <typename T>
void SegmentLinearizer::RunLinearize(const RegistrationPoint* points, size_t count,
                                     Sum* sum) const {
  Lanes<T> lanes{{}, {}, KernelCost(noise_.kernel)};
  const RegistrationPoint* gathered[4];
  for (size_t i = 0; i + kLanes<T> <= count; i += kLanes<T>) {
    for (int lane = 0; lane < kLanes<T>; ++lane) gathered[lane] = points + i + lane;
    LinearizeLanes<T>(gathered, &lanes);
  }
  int index = 0;
  for (int row = 0; row < 12; ++row) {
    for (int lane = 0; lane < kLanes<T>; ++lane) sum->g[row] += At(lanes.g[row], lane);
    for (int column = row; column < 12; ++column, ++index) {
      for (int lane = 0; lane < kLanes<T>; ++lane) sum->H(row, column) += At(lanes.H[index], lane);
    }
  }
  sum->cost += lanes.cost.Total();
}

SegmentLinearizer::Sum SegmentLinearizer::Linearize(const RegistrationPoint* points,
                                                    size_t count) const {
  Sum sum;
  // The series of the Stumpff functions, which the lanes use, hold for rotations below 1 rad.
  const size_t vectorised = motion_.angle_squared < 1.0 ? count / 4 * 4 : 0;
  RunLinearize<Lane4>(points, vectorised, &sum);
  RunLinearize<double>(points + vectorised, count - vectorised, &sum);
  return sum;
}

double SegmentLinearizer::Cost(const RegistrationPoint* points, size_t count) const {
  KernelCost cost(noise_.kernel);
  const double information = 1.0 / (noise_.sigma_m * noise_.sigma_m);
  const size_t vectorised = motion_.angle_squared < 1.0 ? count / 4 * 4 : 0;
  const RegistrationPoint* gathered[4];
  for (size_t i = 0; i < vectorised; i += 4) {
    for (int lane = 0; lane < 4; ++lane) gathered[lane] = points + i + lane;
    Lane4 r = Residual<Lane4>(gathered);
    for (int lane = 0; lane < 4; ++lane) {
      cost.Add(points[i + lane].weight * information * At(r, lane) * At(r, lane));
    }
  }
  for (size_t i = vectorised; i < count; ++i) {
    gathered[0] = points + i;
    const double r = Residual<double>(gathered);
    cost.Add(points[i].weight * information * r * r);
  }
  return cost.Total();
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

void WriteCondensed(const RegistrationNormalEquations& equations, const SE3& T_begin,
                    const SE3& T_end, double* residuals, double** jacobians) {
  Eigen::Map<Eigen::Matrix<double, 13, 1>> r(residuals);
  if (jacobians == nullptr) {
    r.setZero();
    r[12] = std::sqrt(2.0 * equations.cost);
    return;
  }
  const SquareRoot<12> root = MakeSquareRoot<12>(equations.H, equations.g);
  r.head<12>() = root.s;
  r[12] = std::sqrt(std::max(0.0, 2.0 * equations.cost - root.s.squaredNorm()));
  const SE3* poses[2] = {&T_begin, &T_end};
  for (int block = 0; block < 2; ++block) {
    if (jacobians[block] == nullptr) continue;
    Eigen::Map<Eigen::Matrix<double, 13, 7, Eigen::RowMajor>> J(jacobians[block]);
    J.topRows<12>().noalias() = root.S.middleCols<6>(6 * block) * Se3MinusJacobian(*poses[block]);
    J.row(12).setZero();
  }
}

SegmentRegistrationCost::SegmentRegistrationCost(const std::vector<RegistrationPoint>* points,
                                                 const RegistrationNoise& noise)
    : points_(points), noise_(noise) {}

bool SegmentRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                       double** jacobians) const {
  const SE3 T_begin = SE3::FromData(parameters[0]);
  const SE3 T_end = SE3::FromData(parameters[1]);
  const bool is_known = last_ && std::equal(parameters[0], parameters[0] + 7, last_->poses) &&
                        std::equal(parameters[1], parameters[1] + 7, last_->poses + 7);
  if (!is_known) {
    last_.emplace();
    std::copy_n(parameters[0], 7, last_->poses);
    std::copy_n(parameters[1], 7, last_->poses + 7);
    last_->equations = LinearizeSegment(*points_, T_begin, T_end, noise_);
  }
  WriteCondensed(last_->equations, T_begin, T_end, residuals, jacobians);
  return std::isfinite(last_->equations.cost);
}

bool PreparedRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                        double** jacobians) const {
  WriteCondensed(*equations_, SE3::FromData(parameters[0]), SE3::FromData(parameters[1]), residuals,
                 jacobians);
  return std::isfinite(equations_->cost);
}

}  // namespace trajlo
