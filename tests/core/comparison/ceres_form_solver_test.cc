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
  EXPECT_TRUE(MakeSolverFactory(form)(Converging(), &threads)->Solve(&window).finite);
  return window.Poses();
}

TEST(CeresForms, EveryLinearSolverAndTrustRegionEndsAtTheOptimum) {
  const auto expected = SolveByGaussNewton(11);
  for (LinearSolverKind linear :
       {LinearSolverKind::kByLength, LinearSolverKind::kDenseNormalCholesky,
        LinearSolverKind::kDenseQr, LinearSolverKind::kSparseNormalCholesky,
        LinearSolverKind::kCgnr}) {
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

/// A window as a later round finds it: linearised near by, then solved in `steps` steps.
Window SolveAgain(const CeresFormOptions& form, int steps) {
  ThreadPool threads(1);
  SolverOptions options;
  options.iterations_per_round = 1;
  Window window = MakeTestWindow(2);
  MakeWindowSolver(options, &threads)->Solve(&window);
  options.iterations_per_round = steps;
  MakeSolverFactory(form)(options, &threads)->Solve(&window);
  return window;
}

// Also what is left behind, from which the prior is made: an option is not to be judged by it.
TEST(CeresForms, AnOptionChangesNothingElse) {
  std::vector<CeresFormOptions> forms(6);
  forms[1].linear_solver = LinearSolverKind::kDenseQr;
  forms[2].linear_solver = LinearSolverKind::kSparseNormalCholesky;
  forms[3].initial_trust_region_radius = 1e14;
  forms[4].registration = RegistrationForm::kCondensed;
  forms[5].registration = RegistrationForm::kPoint;
  for (const int steps : {1, 3}) {
    const Window expected = SolveAgain({}, steps);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      // Of several steps, CeresSolver keeps the linearisation of the last but one if it is near.
      if (steps > 1 && forms[i].registration != RegistrationForm::kPrepared) continue;
      const Window window = SolveAgain(forms[i], steps);
      EXPECT_LT(LargestDifference(window.Poses(), expected.Poses()), 1e-9)
          << i << ", steps " << steps;
      for (std::size_t k = 0; k < expected.segments.size(); ++k) {
        const auto& own = window.segments[k].registration;
        const auto& wanted = expected.segments[k].registration;
        EXPECT_LT((own.H - wanted.H).norm(), 1e-7 * wanted.H.norm()) << i << ", steps " << steps;
        EXPECT_LT((own.g - wanted.g).norm(), 1e-7 * wanted.H.norm()) << i << ", steps " << steps;
      }
    }
  }
}

}  // namespace
}  // namespace trajlo
