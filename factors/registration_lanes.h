// SPDX-License-Identifier: MIT
// Of segment_linearizer.cc alone: points side by side, and the sums over them. T is double or
// Lane4.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>

#include "factors/registration_point.h"
#include "factors/robust_kernel.h"
#include "factors/segment_linearizer.h"
#include "manifolds/lanes.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo::registration_lanes {

using lanes::At;
using lanes::Broadcast;
using lanes::Broadcast3;
using lanes::Dot;
using lanes::kLanes;
using lanes::Lane4;
using lanes::RotateInverse;
using lanes::Vector3;

/// So many groups of points, each as wide as the lanes, are added to H at a time.
inline constexpr int kGroups = 8;

/// Some points, with one lane for each.
template <typename T>
struct GatheredPoints {
  Vector3<T> p, n;
  T alpha, offset, weight;

  explicit GatheredPoints(const RegistrationPoint* points);
};

template <>
inline GatheredPoints<double>::GatheredPoints(const RegistrationPoint* points)
    : p{points->p_body_m.x(), points->p_body_m.y(), points->p_body_m.z()},
      n{points->normal_world.x(), points->normal_world.y(), points->normal_world.z()},
      alpha(points->alpha),
      offset(points->offset_m),
      weight(points->weight) {}

/// A point begins with p and alpha, four numbers; n and the offset follow.
static_assert(sizeof(RegistrationPoint) == 11 * sizeof(double));
inline Lane4 LoadFour(const RegistrationPoint& point, int first) {
  Lane4 four;
  std::memcpy(&four, reinterpret_cast<const char*>(&point) + first * sizeof(double), sizeof(four));
  return four;
}

template <>
inline GatheredPoints<Lane4>::GatheredPoints(const RegistrationPoint* points)
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

/// At s = alpha² `angle_squared`.
template <typename T>
StumpffSeries<T> StumpffOf(const T& s, double angle_squared) {
  return StumpffSeries<T>(s, angle_squared);
}
template <>
inline StumpffSeries<double> StumpffOf<double>(const double& s, double) {
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

}  // namespace trajlo::registration_lanes
