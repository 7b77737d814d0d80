// SPDX-License-Identifier: MIT
#pragma once

#include "factors/robust_kernel.h"

namespace trajlo {

enum class SolverKind { kCeres, kGaussNewton };
enum class LinearSolverKind {
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
  kPointAutodiff,     ///< The same by automatic differentiation, without first-estimate Jacobians.
};

/// The weights of the energy. A sigma is a standard deviation, and a residual is divided by it.
/// The paper writes covariances Q_r = 0.1 I, Q_v = 0.05 I, its published code weighs smoothness by
/// the number of points; only the ratio of the sigmas and that number matter to the optimum.
struct WeightOptions {
  double registration_sigma_m = 0.1;
  KernelKind kernel = KernelKind::kCauchy;
  /// Width of the kernel: this share of the adaptive threshold, within the bounds below.
  double kernel_in_thresholds = 0.33;
  double min_kernel_m = 0.1;
  double max_kernel_m = 0.5;
  double smoothness_sigma_translation_m = 0.12;
  double smoothness_sigma_rotation_rad = 0.1;
  /// The sigmas are meant for segments up to this long; for longer ones (whole scans) they grow
  /// with the square of the interval, as the way does that an acceleration changes.
  double smoothness_interval_s = 0.03;
  /// Divides both smoothness sigmas by the root of the summed weights of the segment's associated
  /// points, so that the balance between geometry and motion does not depend on the density of the
  /// sensor.
  bool smoothness_scales_with_points = true;
};

/// Only read by the Ceres solver. With these defaults its steps are those of Gauss-Newton to the
/// last bits: no damping, and no tolerance below which Ceres computes a step and then does not take
/// it; the rounds of association end by the size of the steps.
struct CeresOptions {
  RegistrationForm registration = RegistrationForm::kPrepared;
  LinearSolverKind linear_solver = LinearSolverKind::kDenseNormalCholesky;
  TrustRegionKind trust_region = TrustRegionKind::kLevenbergMarquardt;
  double initial_trust_region_radius = 1e16;
  double function_tolerance = 0.0;
  double gradient_tolerance = 0.0;
  double parameter_tolerance = 0.0;
};

struct SolverOptions {
  SolverKind kind = SolverKind::kCeres;
  /// At most this many associate ↔ solve rounds a window.
  int max_rounds = 8;
  /// At most this many solver iterations in each round.
  int iterations_per_round = 1;
  /// The rounds end when no control pose moved by more than these.
  double step_tolerance_m = 1e-3;
  double step_tolerance_rad = 1e-4;
  CeresOptions ceres;
};

struct MarginalizationOptions {
  /// Off: what leaves the window is forgotten and its last pose is held by the anchor's sigmas.
  bool enabled = true;
  bool first_estimate_jacobians = true;
  /// Orthogonal elimination instead of the Schur complement.
  bool use_qr = false;
  /// Standard deviations with which the first control pose is held.
  double anchor_sigma_translation_m = 1e-3;
  double anchor_sigma_rotation_rad = 1e-3;
};

}  // namespace trajlo
