// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/solvers/window_problem.h"

namespace trajlo {

/// How the ratio between geometry and smoothness finds itself.
struct WeightBalanceOptions {
  /// Off: the sigmas of the configuration stand.
  bool enabled = true;
  /// Time over which residuals are remembered.
  double memory_s = 2.0;
  /// The configured sigmas count like residuals of this much time that agree with them.
  double prior_s = 1.0;
  /// Points that hit the same surfaces of the map share its errors: so many count as one. With 1,
  /// what the registration does not explain is taken for motion, and the sigmas run away.
  double points_per_error = 30.0;
  /// The sigmas stay within this factor of the configured ones, up and down.
  double max_factor = 10.0;
};

/// Estimates the factors of the smoothness sigmas from the residuals of solved windows, by variance
/// components (Förstner; the same fixed point as expectation-maximisation): of each group of
/// residuals i with cost E_i = ½ Σ r² and information H_i,
///
///   sigma_i² = 2 E_i / (n_i - tr(H⁻¹ H_i))
///
/// would be 1 if its sigmas were right; the divisor is the share of the group that the solution did
/// not use up. The smoothness sigmas are multiplied by sigma_smoothness / sigma_registration, since
/// only their ratio matters to the optimum; sigma_registration² is that of single points, times the
/// number of points that share an error.
class WeightBalance {
 public:
  explicit WeightBalance(const WeightBalanceOptions& options) : options_(options) {}

  double translation_factor() const { return translation_.factor; }
  double rotation_factor() const { return rotation_.factor; }

  /// Takes the window at its solution, whose registration is linearised there. `duration_s` is
  /// that of the newest segment: how much time this window adds.
  void Update(const WindowProblem& problem,
              const std::vector<RegistrationNormalEquations>& registration, double duration_s);

 private:
  /// Squared residuals in configured sigmas and their redundancy, remembered.
  struct Group {
    double squares = 0.0;
    double redundancy = 0.0;
    double factor = 1.0;

    void Remember(double decay, double new_squares, double new_redundancy);
  };
  void SetFactor(double registration_variance, double redundancy_per_s, Group* group) const;

  WeightBalanceOptions options_;
  Group registration_, translation_, rotation_;
};

}  // namespace trajlo
