// SPDX-License-Identifier: MIT
#include "core/comparison/solver_variant.h"

#include <gmock/gmock.h>

#include "tests/core/config/config_testing.h"
#include "tests/support/room_recording.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::HasSubstr;
using trajlo::testing::ConfigErrorOf;
using trajlo::testing::TempFolder;
using trajlo::testing::WriteFile;

std::vector<SolverVariant> Load(const std::string& yaml, const RunConfig& base = {}) {
  const TempFolder temp;
  WriteFile(temp / "variants.yaml", yaml);
  return LoadVariants(temp / "variants.yaml", base);
}

TEST(SolverVariants, AreTheCommonConfigurationWithChanges) {
  RunConfig base;
  base.odometry.window.segments = 3;
  const auto variants = Load(
      "variants:\n"
      "  - {name: plain}\n"
      "  - {name: paper, set: \"solver.kind=gauss_newton,expert.map.levels=1\"}\n",
      base);
  ASSERT_EQ(variants.size(), 2u);
  EXPECT_EQ(variants[0].odometry.solver.kind, SolverKind::kCeres);
  EXPECT_EQ(variants[1].name, "paper");
  EXPECT_EQ(variants[1].odometry.solver.kind, SolverKind::kGaussNewton);
  EXPECT_EQ(variants[1].odometry.map.levels, 1);
  EXPECT_EQ(variants[1].odometry.window.segments, 3);
}

TEST(SolverVariants, MistakesNameFileAndLine) {
  const auto error = [](const std::string& yaml) { return ConfigErrorOf([&] { Load(yaml); }); };
  EXPECT_THAT(error("nothing: 1\n"), HasSubstr("expected 'variants:'"));
  EXPECT_THAT(error("variants:\n  - {set: \"threads=1\"}\n"), HasSubstr("variants.yaml:2"));
  EXPECT_THAT(error("variants:\n  - {name: a}\n  - {name: a}\n"), HasSubstr("appears twice"));
  EXPECT_THAT(error("variants:\n  - {name: ../a}\n"),
              HasSubstr("must not begin with a dot, nor hold"));
  EXPECT_THAT(error("variants:\n  - {name: \"a,b\"}\n"),
              HasSubstr("must not begin with a dot, nor hold"));
  EXPECT_THAT(error("variants:\n  - {name: a, set: \"solver.knd=ceres\"}\n"),
              HasSubstr("did you mean 'solver.kind'"));
  EXPECT_THAT(error("variants:\n  - {name: a, sets: \"solver.kind=ceres\"}\n"),
              HasSubstr("unknown key 'sets'"));
  EXPECT_THAT(error("variants:\n  - {name: a, set: \"input.point_time=none\"}\n"),
              HasSubstr("read the recording alike"));
  EXPECT_THAT(error("variants: [\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(ConfigErrorOf([] { LoadVariants("/nowhere.yaml", {}); }), HasSubstr("No such file"));
}

TEST(SolverVariants, OnlySolverKernelAndLinearisationConcernASingleWindow) {
  const RunConfig base;
  const auto variants = Load(
      "variants:\n"
      "  - {name: a, set: \"solver.kind=gauss_newton,expert.registration.kernel=huber\"}\n"
      "  - {name: b, set: \"expert.marginalization.first_estimate_jacobians=true\"}\n"
      "  - {name: c, set: \"window.segments=2\"}\n"
      "  - {name: d, set: \"registration.sigma_m=0.2\"}\n");
  EXPECT_TRUE(IsAboutOneWindow(variants[0], base));
  EXPECT_TRUE(IsAboutOneWindow(variants[1], base));
  EXPECT_FALSE(IsAboutOneWindow(variants[2], base));
  EXPECT_FALSE(IsAboutOneWindow(variants[3], base));
}

TEST(SolverVariants, TheShippedOnesLoad) {
  EXPECT_GE(LoadVariants(TRAJLO_CONFIG_DIR "/comparisons/solvers.yaml", {}).size(), 10u);
}

}  // namespace
}  // namespace trajlo
