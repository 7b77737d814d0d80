// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// A quadratic ½ xᵀH x + gᵀx written as ½ |S x + s|² - ½ |s|²: SᵀS = H and Sᵀs = g. N is a size or
/// Eigen::Dynamic.
template <int N>
struct SquareRoot {
  Eigen::Matrix<double, N, N> S;
  Eigen::Matrix<double, N, 1> s;
};

/// The square root of a positive semi-definite H by pivoted LDLᵀ: PHPᵀ = LDLᵀ, S = D^½ Lᵀ P and
/// s = D^-½ L⁻¹ P g. Directions whose pivot is below 1e-14 of the largest one carry no information:
/// their rows are zero (g has no part there when it comes from the same residuals as H).
template <int N>
SquareRoot<N> MakePivotedSquareRoot(const Eigen::Matrix<double, N, N>& H,
                                    const Eigen::Matrix<double, N, 1>& g) {
  const Eigen::Index n = H.rows();
  const Eigen::LDLT<Eigen::Matrix<double, N, N>> ldlt(H);
  const Eigen::Matrix<double, N, 1> D = ldlt.vectorD();
  const double smallest = 1e-14 * D.cwiseAbs().maxCoeff();
  Eigen::Matrix<double, N, 1> root = Eigen::Matrix<double, N, 1>::Zero(n);
  Eigen::Matrix<double, N, 1> inverse_root = Eigen::Matrix<double, N, 1>::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (D[i] > smallest && D[i] > std::numeric_limits<double>::min()) {
      root[i] = std::sqrt(D[i]);
      inverse_root[i] = 1.0 / root[i];
    }
  }
  const auto& P = ldlt.transpositionsP();
  SquareRoot<N> result;
  Eigen::Matrix<double, N, N> permutation = Eigen::Matrix<double, N, N>::Identity(n, n);
  permutation = P * permutation;
  const Eigen::Matrix<double, N, N> upper = ldlt.matrixU();
  result.S.noalias() = root.asDiagonal() * upper * permutation;
  const Eigen::Matrix<double, N, 1> Pg = P * g;
  result.s = inverse_root.cwiseProduct(ldlt.matrixL().solve(Pg));
  return result;
}

/// The square root of a positive semi-definite H: S = Lᵀ and s = L⁻¹ g with the Cholesky factor L,
/// which is several times faster, where H is far from singular, else the pivoted one.
template <int N>
SquareRoot<N> MakeSquareRoot(const Eigen::Matrix<double, N, N>& H,
                             const Eigen::Matrix<double, N, 1>& g) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> llt(H);
  const double smallest_pivot = llt.matrixLLT().diagonal().cwiseAbs2().minCoeff();
  const bool is_regular =
      llt.info() == Eigen::Success && smallest_pivot > 1e-9 * H.diagonal().maxCoeff();
  if (!is_regular) return MakePivotedSquareRoot<N>(H, g);
  return {llt.matrixU(), llt.matrixL().solve(g)};
}

}  // namespace trajlo
