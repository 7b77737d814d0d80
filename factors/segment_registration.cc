// SPDX-License-Identifier: MIT
#include "factors/segment_registration.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

/// So many groups of points, each as wide as the lanes, are added to H at a time.
constexpr int kGroups = 8;

/// Some points, with one lane for each.
template <typename T>
struct GatheredPoints {
  Vector3<T> p, n;
  T alpha, offset, weight;

  explicit GatheredPoints(const RegistrationPoint* points);
};

template <>
GatheredPoints<double>::GatheredPoints(const RegistrationPoint* points)
    : p{points->p_body_m.x(), points->p_body_m.y(), points->p_body_m.z()},
      n{points->normal_world.x(), points->normal_world.y(), points->normal_world.z()},
      alpha(points->alpha),
      offset(points->offset_m),
      weight(points->weight) {}

/// A point begins with p and alpha, four numbers; n and the offset follow.
static_assert(sizeof(RegistrationPoint) == 10 * sizeof(double));
Lane4 LoadFour(const RegistrationPoint& point, int first) {
  Lane4 four;
  std::memcpy(&four, reinterpret_cast<const char*>(&point) + first * sizeof(double), sizeof(four));
  return four;
}

template <>
GatheredPoints<Lane4>::GatheredPoints(const RegistrationPoint* points)
    : p{LoadFour(points[0], 0), LoadFour(points[1], 0), LoadFour(points[2], 0)},
      n{LoadFour(points[0], 4), LoadFour(points[1], 4), LoadFour(points[2], 4)},
      alpha(LoadFour(points[3], 0)),
      offset(LoadFour(points[3], 4)),
      weight{points[0].weight, points[1].weight, points[2].weight, points[3].weight} {
  lanes::Transpose(&p.x, &p.y, &p.z, &alpha);
  lanes::Transpose(&n.x, &n.y, &n.z, &offset);
}

/// The weights rho'(s), and the sum of ½ rho(s_i).
///
/// For Cauchy, that is a/2 log prod (1 + s_i/a): one logarithm for many points. A product of
/// kGroups factors is far from the largest number.
template <typename T>
class KernelSum {
 public:
  explicit KernelSum(const RobustKernel& kernel)
      : kernel_(kernel), a_(kernel.width * kernel.width), inverse_a_(1.0 / a_) {}

  T AddAndWeigh(const T& s) {
    Add(s);
    if (kernel_.kind == KernelKind::kCauchy) return a_ / (a_ + s);
    T weight;
    for (int i = 0; i < kLanes<T>; ++i) At(weight, i) = kernel_.Weight(At(s, i));
    return weight;
  }
  void Add(const T& s) {
    if (kernel_.kind == KernelKind::kCauchy) {
      product_ *= 1.0 + s * inverse_a_;
      return;
    }
    for (int i = 0; i < kLanes<T>; ++i) sum_ += kernel_.Rho(At(s, i));
  }
  /// To be called after at most kGroups additions.
  void EndBlock() {
    for (int i = 0; i < kLanes<T>; ++i) {
      if (!(At(product_, i) < 1e100)) {
        sum_ += std::log(At(product_, i)) * a_;
        At(product_, i) = 1.0;
      }
    }
  }
  double Total() {
    for (int i = 0; i < kLanes<T>; ++i) sum_ += std::log(At(product_, i)) * a_;
    product_ = Broadcast<T>(1.0);
    return 0.5 * sum_;
  }

 private:
  RobustKernel kernel_;
  double a_, inverse_a_;
  T product_ = Broadcast<T>(1.0);
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

namespace {

/// At s = alpha² `angle_squared`.
template <typename T>
StumpffSeries<T> StumpffOf(const T& s, double angle_squared) {
  return StumpffSeries<T>(s, angle_squared);
}
template <>
StumpffSeries<double> StumpffOf<double>(const double& s, double) {
  return Stumpff(s);
}

/// Some points in the begin frame, and their distances r to their planes (m).
template <typename T>
struct LocatedPoints {
  T alpha, weight;
  StumpffSeries<T> c;
  Vector3<T> p0, n0;
  T r;

  LocatedPoints(const GatheredPoints<T>& in, const SegmentMotion& m)
      : alpha(in.alpha),
        weight(in.weight),
        c(StumpffOf<T>(alpha * alpha * m.angle_squared, m.angle_squared)),
        p0(m.MoveToBegin<T>(alpha, c, in.p)),
        n0(RotateInverse(m.R_begin, in.n)),
        r(Dot(n0, p0) + (Dot(in.n, Broadcast3<T>(m.t_begin)) - in.offset)) {}
};

/// Sums over [j; v] by blocks of 3 x 3, which the registers hold while a block of points is added.
template <typename T>
class BlockSum {
 public:
  /// Row `row` of group `group`: u, and what it is to be multiplied with.
  void Set(int group, int row, const T& u, const T& wu) {
    u_[row][group] = u;
    wu_[row][group] = wu;
  }
  void AddGroups(int groups) {
    for (int row = 0, block = 0; row < 12; row += 3) {
      for (int column = row; column < 12; column += 3, ++block) AddTo(block, row, column, groups);
    }
  }
  /// The upper triangle.
  void AddTo(Matrix12d* H) const {
    for (int row = 0, block = 0; row < 12; row += 3) {
      for (int column = row; column < 12; column += 3, ++block) {
        for (int i = 0; i < 9; ++i) {
          if (column + i % 3 < row + i / 3) continue;
          for (int lane = 0; lane < kLanes<T>; ++lane) {
            (*H)(row + i / 3, column + i % 3) += At(H_[block][i], lane);
          }
        }
      }
    }
  }

 private:
  void AddTo(int block, int row, int column, int groups) {
    T sum[9];
    std::copy_n(H_[block], 9, sum);
    for (int g = 0; g < groups; ++g) {
      const T a0 = wu_[row][g], a1 = wu_[row + 1][g], a2 = wu_[row + 2][g];
      const T b0 = u_[column][g], b1 = u_[column + 1][g], b2 = u_[column + 2][g];
      sum[0] += a0 * b0;
      sum[1] += a0 * b1;
      sum[2] += a0 * b2;
      sum[3] += a1 * b0;
      sum[4] += a1 * b1;
      sum[5] += a1 * b2;
      sum[6] += a2 * b0;
      sum[7] += a2 * b1;
      sum[8] += a2 * b2;
    }
    std::copy_n(sum, 9, H_[block]);
  }

  T u_[12][kGroups], wu_[12][kGroups];
  T H_[10][9] = {};
};

}  // namespace

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

bool PreparedRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                        double** jacobians) const {
  Eigen::Map<Eigen::Matrix<double, 13, 1>> r(residuals);
  if (jacobians == nullptr) {
    r.setZero();
    r[12] = std::sqrt(2.0 * equations_->cost);
    return std::isfinite(equations_->cost);
  }
  const SquareRoot<12> root = MakeSquareRoot<12>(equations_->H, equations_->g);
  r.head<12>() = root.s;
  r[12] = std::sqrt(std::max(0.0, 2.0 * equations_->cost - root.s.squaredNorm()));
  Eigen::Matrix<double, 13, 12> J;
  J << root.S, Eigen::Matrix<double, 1, 12>::Zero();
  const SE3 T[2] = {SE3::FromData(parameters[0]), SE3::FromData(parameters[1])};
  WriteJacobians(T, J, jacobians);
  return std::isfinite(equations_->cost);
}

bool SegmentRegistrationCost::Evaluate(double const* const* parameters, double* residuals,
                                       double** jacobians) const {
  const bool is_known = last_ &&
                        std::equal(parameters[0], parameters[0] + 7, last_->T_begin.data()) &&
                        std::equal(parameters[1], parameters[1] + 7, last_->T_end.data());
  if (!is_known) {
    const SE3 T_begin = SE3::FromData(parameters[0]);
    const SE3 T_end = SE3::FromData(parameters[1]);
    last_ = {T_begin, T_end, LinearizeSegment(*points_, T_begin, T_end, noise_)};
  }
  return PreparedRegistrationCost(&last_->equations).Evaluate(parameters, residuals, jacobians);
}

}  // namespace trajlo
