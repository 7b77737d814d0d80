// SPDX-License-Identifier: MIT
#include "core/comparison/forms/ceres_form_solver.h"

#include <gtest/gtest.h>

#include "tests/support/test_window.h"

namespace trajlo {
namespace {

using testing::LargestDifference;
using testing::MakeTestWindow;

SolverOptions Converging() {
  SolverOptions options;
  options.iterations_per_round = 60;
  options.step_tolerance = {1e-11, 1e-11};
  return options;
}

std::vector<SE3> SolveByGaussNewton(unsigned seed) {
  ThreadPool threads(1);
  Window window = MakeTestWindow(seed);
  SolverOptions options = Converging();
  options.kind = SolverKind::kGaussNewton;
  MakeWindowSolver(options, &threads)->Solve(&window);
  return window.Poses();
}

std::vector<SE3> SolveByForm(const CeresFormOptions& form, unsigned seed) {
  ThreadPool threads(1);
  Window window = MakeTestWindow(seed);
  EXPECT_TRUE(CeresFormSolver(form, Converging(), &threads).Solve(&window).finite);
  return window.Poses();
}

TEST(CeresForms, EveryLinearSolverAndTrustRegionEndsAtTheOptimum) {
  const auto expected = SolveByGaussNewton(11);
  for (LinearSolverKind linear :
       {LinearSolverKind::kDenseNormalCholesky, LinearSolverKind::kDenseQr,
        LinearSolverKind::kSparseNormalCholesky, LinearSolverKind::kCgnr}) {
    for (TrustRegionKind region :
         {TrustRegionKind::kLevenbergMarquardt, TrustRegionKind::kDogleg}) {
      if (linear == LinearSolverKind::kCgnr && region == TrustRegionKind::kDogleg) continue;
      CeresFormOptions form;
      form.linear_solver = linear;
      form.trust_region = region;
      EXPECT_LT(LargestDifference(SolveByForm(form, 11), expected), 1e-6)
          << static_cast<int>(linear) << " " << static_cast<int>(region);
    }
  }
}

TEST(CeresForms, EveryFormOfTheRegistrationEndsAtTheOptimum) {
  const auto expected = SolveByGaussNewton(13);
  for (RegistrationForm registration :
       {RegistrationForm::kPrepared, RegistrationForm::kCondensed, RegistrationForm::kPoint,
        RegistrationForm::kPointAutodiff, RegistrationForm::kSegmentResiduals}) {
    CeresFormOptions form;
    form.registration = registration;
    // The root of the kernel overshoots far from the optimum: it needs the trust region.
    if (registration == RegistrationForm::kSegmentResiduals) form.initial_trust_region_radius = 1e4;
    EXPECT_LT(LargestDifference(SolveByForm(form, 13), expected), 1e-6)
        << static_cast<int>(registration);
  }
}

TEST(CeresForms, TheDefaultFormIsTheProductsOwnSolver) {
  ThreadPool threads(1);
  SolverOptions options;
  options.iterations_per_round = 1;
  Window form = MakeTestWindow(2), own = form;
  CeresFormSolver({}, options, &threads).Solve(&form);
  MakeWindowSolver(options, &threads)->Solve(&own);
  EXPECT_LT(LargestDifference(form.Poses(), own.Poses()), 1e-12);
}

}  // namespace
}  // namespace trajlo
