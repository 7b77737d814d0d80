// SPDX-License-Identifier: MIT
#include "core/comparison/variant_doubt.h"

#include <gmock/gmock.h>

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

SolverVariant Variant(const std::string& name, const std::string& settings) {
  RunConfig config;
  ApplyOverrides(settings, &config);
  return {name, settings, config.odometry, config.ceres_form};
}

std::vector<std::string> Doubts(const std::vector<SolverVariant>& variants, bool lockstep = true) {
  return DoubtVariants(variants, {}, lockstep);
}

TEST(VariantDoubt, OptionsOfCeresHaveNoEffectOnGaussNewton) {
  const auto doubts =
      Doubts({Variant("gn", "solver.kind=gauss_newton"),
              Variant("gn_qr",
                      "solver.kind=gauss_newton,expert.solver.ceres.linear_solver=dense_qr,"
                      "expert.solver.ceres.initial_trust_region_radius=1e4"),
              Variant("ceres_qr", "expert.solver.ceres.linear_solver=dense_qr")});
  EXPECT_THAT(doubts,
              ElementsAre(AllOf(
                  HasSubstr("'gn_qr': expert.solver.ceres.linear_solver and "
                            "expert.solver.ceres.initial_trust_region_radius have no effect with "
                            "solver.kind=gauss_newton"),
                  HasSubstr("the same as 'gn'"))));
}

TEST(VariantDoubt, OneWithAnotherEffectIsNotTheSame) {
  EXPECT_THAT(
      Doubts({Variant("gn", "solver.kind=gauss_newton"),
              Variant("huber",
                      "solver.kind=gauss_newton,expert.registration.kernel=huber,"
                      "expert.solver.ceres.linear_solver=dense_qr")}),
      ElementsAre(AllOf(HasSubstr("linear_solver has no effect"), Not(HasSubstr("the same")))));
}

TEST(VariantDoubt, TheSameUnderTwoNamesIsTold) {
  // The default is what 'b' sets.
  EXPECT_THAT(
      Doubts({Variant("a", ""), Variant("b", "solver.kind=ceres"),
              Variant("c", "solver.kind=gauss_newton")}),
      ElementsAre("'b': it is the same as 'a', and any difference between the two is noise"));
}

TEST(VariantDoubt, RoundsHaveNoEffectOnWindowsThatAreComparedOneByOne) {
  const std::vector<SolverVariant> variants = {
      Variant("a", ""), Variant("fine", "expert.solver.step_tolerance_m=0.0001"),
      Variant("two", "expert.solver.max_rounds=2,window.segments=2")};
  EXPECT_THAT(Doubts(variants),
              ElementsAre(HasSubstr("'fine': expert.solver.step_tolerance_m has no effect in "
                                    "lockstep")));
  EXPECT_THAT(Doubts(variants, false), IsEmpty());
}

TEST(VariantDoubt, TheShippedOnesAreAllDifferent) {
  EXPECT_THAT(Doubts(LoadVariants(TRAJLO_CONFIG_DIR "/comparisons/solvers.yaml", {})), IsEmpty());
}

}  // namespace
}  // namespace trajlo
