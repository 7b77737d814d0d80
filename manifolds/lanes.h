// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "manifolds/eigen_abi.h"

/// The few operations of 3-vectors that moving and registering points needs, for one double or for
/// four points at a time. (Eigen's own vectorisation is off in this project; see CMakeLists.txt.)
namespace trajlo::lanes {

/// Four points at a time: GCC and Clang turn this into AVX, or into pairs of SSE2 where that is
/// all.
typedef double Lane4 __attribute__((vector_size(32)));  // NOLINT(modernize-use-using): GCC's form
typedef float Float4 __attribute__((vector_size(16)));  // NOLINT(modernize-use-using)

/// Lanes of a and b by number: 0 to 3 are those of a, 4 to 7 those of b.
template <int i, int j, int k, int l>
Lane4 Shuffle(const Lane4& a, const Lane4& b) {
#ifdef __clang__
  return __builtin_shufflevector(a, b, i, j, k, l);
#else
  typedef long long Mask __attribute__((vector_size(32)));  // NOLINT(modernize-use-using)
  return __builtin_shuffle(a, b, Mask{i, j, k, l});
#endif
}

/// Rows become columns.
inline void Transpose(Lane4* a, Lane4* b, Lane4* c, Lane4* d) {
  const Lane4 ab_even = Shuffle<0, 4, 2, 6>(*a, *b), ab_odd = Shuffle<1, 5, 3, 7>(*a, *b);
  const Lane4 cd_even = Shuffle<0, 4, 2, 6>(*c, *d), cd_odd = Shuffle<1, 5, 3, 7>(*c, *d);
  *a = Shuffle<0, 1, 4, 5>(ab_even, cd_even);
  *b = Shuffle<0, 1, 4, 5>(ab_odd, cd_odd);
  *c = Shuffle<2, 3, 6, 7>(ab_even, cd_even);
  *d = Shuffle<2, 3, 6, 7>(ab_odd, cd_odd);
}

template <typename T>
T Broadcast(double value) {
  return value - T{};
}

template <typename T>
struct Vector3 {
  T x, y, z;
  friend Vector3 operator+(const Vector3& a, const Vector3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Vector3 operator*(const T& s, const Vector3& v) { return {s * v.x, s * v.y, s * v.z}; }
};

template <typename T>
Vector3<T> Broadcast3(const Eigen::Vector3d& v) {
  return {Broadcast<T>(v.x()), Broadcast<T>(v.y()), Broadcast<T>(v.z())};
}

template <typename T>
Vector3<T> Cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <typename T>
T Dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// R v.
template <typename T>
Vector3<T> Rotate(const Eigen::Matrix3d& R, const Vector3<T>& v) {
  return {R(0, 0) * v.x + R(0, 1) * v.y + R(0, 2) * v.z,
          R(1, 0) * v.x + R(1, 1) * v.y + R(1, 2) * v.z,
          R(2, 0) * v.x + R(2, 1) * v.y + R(2, 2) * v.z};
}

/// Rᵀ v.
template <typename T>
Vector3<T> RotateInverse(const Eigen::Matrix3d& R, const Vector3<T>& v) {
  return {R(0, 0) * v.x + R(1, 0) * v.y + R(2, 0) * v.z,
          R(0, 1) * v.x + R(1, 1) * v.y + R(2, 1) * v.z,
          R(0, 2) * v.x + R(1, 2) * v.y + R(2, 2) * v.z};
}

}  // namespace trajlo::lanes
