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
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  Matrix S;
  Vector s;
};

/// A direction with less than this share of the largest information has none: the rest is rounding.
constexpr double kNoInformation = 1e-14;

/// The square root of a positive semi-definite H by pivoted LDLᵀ: PHPᵀ = LDLᵀ, S = D^½ Lᵀ P and
/// s = D^-½ L⁻¹ P g. Directions whose pivot is below kNoInformation of the largest one carry none:
/// their rows are zero (g has no part there when it comes from the same residuals as H).
template <int N>
SquareRoot<N> MakePivotedSquareRoot(const typename SquareRoot<N>::Matrix& H,
                                    const typename SquareRoot<N>::Vector& g) {
  using Matrix = typename SquareRoot<N>::Matrix;
  using Vector = typename SquareRoot<N>::Vector;
  const Eigen::LDLT<Matrix> ldlt(H);
  const Vector D = ldlt.vectorD();
  const double smallest = kNoInformation * D.cwiseAbs().maxCoeff();
  Vector root = Vector::Zero(D.size());
  Vector inverse_root = root;
  for (Eigen::Index i = 0; i < D.size(); ++i) {
    if (D[i] > smallest && D[i] > std::numeric_limits<double>::min()) {
      root[i] = std::sqrt(D[i]);
      inverse_root[i] = 1.0 / root[i];
    }
  }
  const auto& P = ldlt.transpositionsP();
  const Matrix upper = ldlt.matrixU();
  // As a matrix: Eigen applies transpositions from the right in the other order.
  const Matrix permutation = P * Matrix::Identity(D.size(), D.size());
  const Vector Pg = P * g;
  return {root.asDiagonal() * upper * permutation,
          inverse_root.cwiseProduct(ldlt.matrixL().solve(Pg))};
}

/// The square root of a positive semi-definite H: S = Lᵀ and s = L⁻¹ g with the Cholesky factor L,
/// which is several times faster, where H is far from singular, else the pivoted one.
template <int N>
SquareRoot<N> MakeSquareRoot(const typename SquareRoot<N>::Matrix& H,
                             const typename SquareRoot<N>::Vector& g) {
  const Eigen::LLT<typename SquareRoot<N>::Matrix> llt(H);
  const double smallest_pivot = llt.matrixLLT().diagonal().cwiseAbs2().minCoeff();
  const bool is_regular =
      llt.info() == Eigen::Success && smallest_pivot > 1e-9 * H.diagonal().maxCoeff();
  if (!is_regular) return MakePivotedSquareRoot<N>(H, g);
  return {llt.matrixU(), llt.matrixL().solve(g)};
}

}  // namespace trajlo
