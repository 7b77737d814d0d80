// SPDX-License-Identifier: MIT
#pragma once

namespace trajlo {

enum class LinearSolverKind { kDenseNormalCholesky, kDenseQr, kSparseNormalCholesky, kCgnr };
enum class TrustRegionKind { kLevenbergMarquardt, kDogleg };

/// How the registration of a segment enters Ceres.
enum class RegistrationForm {
  kPrepared,          ///< Condensed to 13 rows, computed for all segments in parallel.
  kCondensed,         ///< Condensed to 13 rows, each block by itself.
  kSegmentResiduals,  ///< One block with one residual a point.
  kPoint,             ///< One block a point, the plain reference.
  kPointAutodiff,     ///< The same by automatic differentiation.
};

/// Other ways to let Ceres solve a window than that of CeresSolver, which the defaults stand for.
struct CeresFormOptions {
  RegistrationForm registration = RegistrationForm::kPrepared;
  LinearSolverKind linear_solver = LinearSolverKind::kDenseNormalCholesky;
  TrustRegionKind trust_region = TrustRegionKind::kLevenbergMarquardt;
  double initial_trust_region_radius = 1e16;

  bool IsDefault() const {
    return registration == RegistrationForm::kPrepared &&
           linear_solver == LinearSolverKind::kDenseNormalCholesky &&
           trust_region == TrustRegionKind::kLevenbergMarquardt &&
           initial_trust_region_radius == 1e16;
  }
};

}  // namespace trajlo
