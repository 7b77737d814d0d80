// SPDX-License-Identifier: MIT
// How a window is solved, and what it leaves behind.
#include "core/config/options/bind_options.h"
#include "core/config/options/option_binder.h"

namespace trajlo {
namespace {

const Names<SolverKind> kSolvers = {{"ceres", SolverKind::kCeres},
                                    {"gauss_newton", SolverKind::kGaussNewton}};
const Names<LinearSolverKind> kLinearSolvers = {
    {"dense_normal_cholesky", LinearSolverKind::kDenseNormalCholesky},
    {"dense_qr", LinearSolverKind::kDenseQr},
    {"sparse_normal_cholesky", LinearSolverKind::kSparseNormalCholesky},
    {"cgnr", LinearSolverKind::kCgnr}};
const Names<RegistrationForm> kRegistrationForms = {
    {"prepared", RegistrationForm::kPrepared},
    {"condensed", RegistrationForm::kCondensed},
    {"segment_residuals", RegistrationForm::kSegmentResiduals},
    {"point", RegistrationForm::kPoint},
    {"point_autodiff", RegistrationForm::kPointAutodiff}};
const Names<TrustRegionKind> kTrustRegions = {
    {"levenberg_marquardt", TrustRegionKind::kLevenbergMarquardt},
    {"dogleg", TrustRegionKind::kDogleg}};

}  // namespace

void BindSolver(SolverOptions* solver, CeresFormOptions* form, OptionBinder* b) {
  b->Add("solver.kind", solver->kind, kSolvers,
         "Ceres, or the hand-written Gauss-Newton of the paper.");
  b->Add("solver.max_rounds", solver->max_rounds, Range<int>{1, 1000},
         "At most this many rounds of association and solve a window.");
  b->Add("solver.iterations_per_round", solver->iterations_per_round, Range<int>{1, 1000},
         "At most this many solver iterations in each round.");
  b->Add("solver.step_tolerance_m", solver->step_tolerance.translation_m, Range<double>{0.0, 1.0},
         "The rounds end when no control pose moved by more than this ...");
  b->Add("solver.step_tolerance_rad", solver->step_tolerance.rotation_rad, Range<double>{0.0, 1.0},
         "... and turned by no more than this.");
  b->Add("solver.ceres.registration", form->registration, kRegistrationForms,
         "How the registration enters Ceres: 13 condensed rows a segment, computed in parallel or "
         "each by itself; one block a segment with a residual a point; one block a point with "
         "analytic or automatic Jacobians.");
  b->Add("solver.ceres.linear_solver", form->linear_solver, kLinearSolvers,
         "How Ceres solves the normal equations.");
  b->Add("solver.ceres.trust_region", form->trust_region, kTrustRegions,
         "How Ceres bounds its steps.");
  b->Add("solver.ceres.initial_trust_region_radius", form->initial_trust_region_radius,
         Range<double>{1e-10, 1e16},
         "The largest makes the first step a Gauss-Newton step to the last bits.");
}

void BindMarginalization(MarginalizationOptions* marginalization, OptionBinder* b) {
  b->Add("marginalization.enabled", marginalization->enabled,
         "false: what leaves the window is forgotten, and its last pose is held by the anchor's "
         "sigmas.");
  b->Add("marginalization.first_estimate_jacobians", marginalization->first_estimate_jacobians,
         "Keeps the Jacobian of the prior as it was where the poses left.");
  b->Add("marginalization.use_qr", marginalization->use_qr,
         "Orthogonal elimination in place of the Schur complement.");
  b->Add("marginalization.anchor_sigma_translation_m", marginalization->anchor_sigma_translation_m,
         Range<double>{1e-9, 1e3}, "Sigma with which the first control pose is held.");
  b->Add("marginalization.anchor_sigma_rotation_rad", marginalization->anchor_sigma_rotation_rad,
         Range<double>{1e-9, 1e3}, "The same for its rotation.");
}

}  // namespace trajlo
