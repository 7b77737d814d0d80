// SPDX-License-Identifier: MIT
// Four points of a segment side by side, and the sums over them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "factors/registration_point.h"
#include "factors/robust_kernel.h"
#include "factors/segment_linearizer.h"
#include "manifolds/lanes.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo::registration_lanes {

using lanes::Broadcast3;
using lanes::Dot;
using lanes::Lane4;
using lanes::RotateInverse;
using lanes::Vector3;

inline constexpr int kLanes = 4;
/// This many groups of four points are added to H at a time.
inline constexpr int kGroups = 8;

/// A point begins with p and alpha, four numbers; n and the offset follow.
static_assert(sizeof(RegistrationPoint) == 12 * sizeof(double));
inline Lane4 LoadFour(const RegistrationPoint& point, int first) {
  Lane4 four;
  std::memcpy(&four, reinterpret_cast<const char*>(&point) + first * sizeof(double), sizeof(four));
  return four;
}

/// The axes of four points.
using LaneAxes = std::array<std::size_t, kLanes>;

/// Four points, with one lane for each.
struct GatheredPoints {
  Vector3<Lane4> p, n;
  Lane4 alpha, offset, weight;
  LaneAxes axis;

  GatheredPoints(const RegistrationPoint& p0, const RegistrationPoint& p1,
                 const RegistrationPoint& p2, const RegistrationPoint& p3)
      : p{LoadFour(p0, 0), LoadFour(p1, 0), LoadFour(p2, 0)},
        n{LoadFour(p0, 4), LoadFour(p1, 4), LoadFour(p2, 4)},
        alpha(LoadFour(p3, 0)),
        offset(LoadFour(p3, 4)),
        weight{p0.weight, p1.weight, p2.weight, p3.weight},
        axis{p0.axis, p1.axis, p2.axis, p3.axis} {
    lanes::Transpose(&p.x, &p.y, &p.z, &alpha);
    lanes::Transpose(&n.x, &n.y, &n.z, &offset);
  }
};

/// The first four of every `stride`-th point. Where there are fewer, the other lanes have no
/// weight.
inline GatheredPoints Gather(const RegistrationPoint* points, std::size_t count,
                             std::size_t stride = 1) {
  const auto point = [&](std::size_t i) -> const RegistrationPoint& {
    return points[stride * std::min(i, count - 1)];
  };
  GatheredPoints gathered(point(0), point(1), point(2), point(3));
  for (std::size_t i = count; i < kLanes; ++i) gathered.weight[i] = 0.0;
  return gathered;
}

/// The kernels of the three axes.
class AxisKernels {
 public:
  explicit AxisKernels(const RegistrationNoise& noise)
      : is_cauchy_(noise.kernel.kind == KernelKind::kCauchy) {
    for (std::size_t i = 0; i < 3; ++i) {
      kernels_[i] = noise.KernelOf(i);
      a_[i] = kernels_[i].width * kernels_[i].width;
    }
  }
  bool is_cauchy() const { return is_cauchy_; }

  const RobustKernel& Of(std::size_t axis) const { return kernels_[axis]; }
  /// Squares of the widths.
  double Square(std::size_t axis) const { return a_[axis]; }
  Lane4 Squares(const LaneAxes& axis) const {
    const Lane4 squares = {a_[axis[0]], a_[axis[1]], a_[axis[2]], a_[axis[3]]};
    return squares;
  }
  /// rho'(s).
  Lane4 Weight(const LaneAxes& axis, const Lane4& s) const {
    if (is_cauchy_) {
      const Lane4 a = Squares(axis);
      return a / (a + s);
    }
    Lane4 weight{};
    for (std::size_t i = 0; i < kLanes; ++i) weight[i] = Of(axis[i]).Weight(s[i]);
    return weight;
  }

 private:
  bool is_cauchy_;
  std::array<RobustKernel, 3> kernels_;
  std::array<double, 3> a_;
};

/// The sum of ½ rho(s_i).
///
/// For Cauchy, that is a/2 log prod (1 + s_i/a) for each axis: one logarithm for many points. A
/// product of kGroups factors is far from the largest number.
class KernelSum {
 public:
  explicit KernelSum(const AxisKernels& kernels) : kernels_(kernels) {}

  void Add(const LaneAxes& axis, const Lane4& s) {
    if (kernels_.is_cauchy()) {
      const Lane4 factor = 1.0 + s / kernels_.Squares(axis);
      for (std::size_t i = 0; i < kLanes; ++i) product_[axis[i]][i] *= factor[i];
      return;
    }
    for (std::size_t i = 0; i < kLanes; ++i) sum_ += kernels_.Of(axis[i]).Rho(s[i]);
  }
  /// To be called after at most kGroups additions.
  void EndBlock() { TakeLogarithms(1e100); }
  double Total() {
    TakeLogarithms(0.0);
    return 0.5 * sum_;
  }

 private:
  /// Adds the logarithms of the products that are not below `bound`.
  void TakeLogarithms(double bound) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (double& product : product_[axis]) {
        if (product < bound) continue;
        sum_ += std::log(product) * kernels_.Square(axis);
        product = 1.0;
      }
    }
  }

  const AxisKernels& kernels_;
  std::array<std::array<double, kLanes>, 3> product_ = {
      {{1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 1.0}, {1.0, 1.0, 1.0, 1.0}}};
  double sum_ = 0.0;
};

/// Some points in the begin frame, and their distances r to their planes (m).
struct LocatedPoints {
  Lane4 alpha, weight;
  LaneAxes axis;
  StumpffSeries<Lane4> c;
  Vector3<Lane4> p0, n0;
  Lane4 r;

  LocatedPoints(const GatheredPoints& in, const SegmentMotion& m)
      : alpha(in.alpha),
        weight(in.weight),
        axis(in.axis),
        c(m.StumpffAt(alpha)),
        p0(m.MoveToBegin<Lane4>(alpha, c, in.p)),
        n0(RotateInverse(m.R_begin, in.n)),
        r(Dot(n0, p0) + (Dot(in.n, Broadcast3<Lane4>(m.t_begin)) - in.offset)) {}
};

/// Sums over [j; v] by blocks of 3 x 3, which the registers hold while a block of points is added.
class BlockSum {
 public:
  /// Row `row` of group `group`: u, and what it is to be multiplied with.
  void Set(int group, int row, const Lane4& u, const Lane4& wu) {
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
          for (int lane = 0; lane < kLanes; ++lane) {
            (*H)(row + i / 3, column + i % 3) += H_[block][i][lane];
          }
        }
      }
    }
  }

 private:
  void AddTo(int block, int row, int column, int groups) {
    Lane4 sum[9];
    std::copy_n(H_[block], 9, sum);
    for (int g = 0; g < groups; ++g) {
      const Lane4 a0 = wu_[row][g], a1 = wu_[row + 1][g], a2 = wu_[row + 2][g];
      const Lane4 b0 = u_[column][g], b1 = u_[column + 1][g], b2 = u_[column + 2][g];
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

  Lane4 u_[12][kGroups], wu_[12][kGroups];
  Lane4 H_[10][9] = {};
};

}  // namespace trajlo::registration_lanes
