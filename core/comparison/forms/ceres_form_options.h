// SPDX-License-Identifier: MIT
#pragma once

#include "core/options/describe.h"

namespace trajlo {

enum class LinearSolverKind {
  kByLength,  ///< A dense Cholesky factorisation, or a sparse one in long windows.
  kDenseNormalCholesky,
  kDenseQr,
  kSparseNormalCholesky,
  kCgnr,
};
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
  LinearSolverKind linear_solver = LinearSolverKind::kByLength;
  TrustRegionKind trust_region = TrustRegionKind::kLevenbergMarquardt;
  double initial_trust_region_radius = 1e16;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "registration", registration,
      Names<RegistrationForm>{{"prepared", RegistrationForm::kPrepared},
                              {"condensed", RegistrationForm::kCondensed},
                              {"segment_residuals", RegistrationForm::kSegmentResiduals},
                              {"point", RegistrationForm::kPoint},
                              {"point_autodiff", RegistrationForm::kPointAutodiff}},
      "How the registration enters Ceres: 13 condensed rows a segment, computed in parallel or "
      "each by itself; one block a segment with a residual a point; one block a point with "
      "analytic or automatic Jacobians. Only the default keeps linearisations within "
      "expert.solver.step_tolerance_m.");
    d(OptionFor::kExperts, "linear_solver", linear_solver,
      Names<LinearSolverKind>{{"by_length", LinearSolverKind::kByLength},
                              {"dense_normal_cholesky", LinearSolverKind::kDenseNormalCholesky},
                              {"dense_qr", LinearSolverKind::kDenseQr},
                              {"sparse_normal_cholesky", LinearSolverKind::kSparseNormalCholesky},
                              {"cgnr", LinearSolverKind::kCgnr}},
      "How Ceres solves the normal equations; by_length: by a dense Cholesky factorisation, or a "
      "sparse one in windows of more than 16 poses.");
    d(OptionFor::kExperts, "trust_region", trust_region,
      Names<TrustRegionKind>{{"levenberg_marquardt", TrustRegionKind::kLevenbergMarquardt},
                             {"dogleg", TrustRegionKind::kDogleg}},
      "How Ceres bounds its steps.");
    d(OptionFor::kExperts, "initial_trust_region_radius", initial_trust_region_radius,
      Range<double>{1e-10, 1e16},
      "At its largest, the first step is a Gauss-Newton step to the last bits.");
  }
};

}  // namespace trajlo
