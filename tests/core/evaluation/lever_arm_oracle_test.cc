// SPDX-License-Identifier: MIT
// A body trajectory against the path of a prism that is mounted on it.
#include "tests/core/evaluation/evaluation_testing.h"

namespace trajlo::testing {
namespace {

class LeverArmOracle : public OracleTest {};

EvaluationOptions OptionsOf(const nlohmann::json& expected) {
  EvaluationOptions options = EvoOptions(AlignmentOf(expected["alignment"]));
  if (expected["n_to_align"] > 0) options.alignment.first_pairs = expected["n_to_align"];
  if (!expected["lever_arm"].is_null()) {
    const auto lever = expected["lever_arm"].get<std::vector<double>>();
    options.T_body_truth = Eigen::Translation3d(lever[0], lever[1], lever[2]);
  }
  return options;
}

TEST_F(LeverArmOracle, EveryCaseAgrees) {
  std::size_t compared = 0;
  const nlohmann::json cases = ReadJson("lever_arm.json")["cases"];
  for (const nlohmann::json& expected : cases) {
    SCOPED_TRACE(expected["id"].get<std::string>());
    const Evaluation evaluation =
        Evaluate(Poses(expected["est"]), Poses(expected["ref"]), OptionsOf(expected));
    EXPECT_EQ(evaluation.pairs.size(), expected["poses_associated"].get<std::size_t>());
    const std::string relation = expected["pose_relation"];
    const ErrorStatistics& statistics = relation == "angle_deg" ? evaluation.absolute.rotation_deg
                                        : relation == "full"    ? evaluation.absolute.full
                                                                : evaluation.absolute.translation_m;
    ExpectStatistics(
        statistics, [&](const char* name) { return expected["stats"][name].get<double>(); }, 1e-9,
        relation == "angle_deg" ? 1e-9 : 0.0);
    ++compared;
  }
  EXPECT_EQ(compared, 10u);
}

TEST_F(LeverArmOracle, APrismHasNoOrientationSoNoAngleIsComputed) {
  EvaluationOptions options;
  options.relative.push_back({});
  const TimedPoses& truth = Poses("lever_arm/prism_groundtruth.tum");
  const Evaluation evaluation = Evaluate(Poses("lever_arm/body_estimate.tum"), truth, options);
  EXPECT_FALSE(evaluation.has_orientation);
  EXPECT_EQ(evaluation.absolute.rotation_deg.count, 0u);
  EXPECT_EQ(evaluation.relative[0].statistics.translation_m.count, 0u);
  EXPECT_GT(evaluation.relative[0].statistics.point_distance_m.count, 20u);
  EXPECT_FALSE(evaluation.kitti.has_value());
  EXPECT_THAT(evaluation.kitti_reason, ::testing::HasSubstr("no orientation"));
}

// The README of the data gives these to six digits, from an evaluation of its own.
TEST_F(LeverArmOracle, InterpolationAgreesWhicheverOfTheTwoIsInterpolated) {
  EvaluationOptions options;
  options.T_body_truth = Eigen::Translation3d(-0.293656, -0.012288, -0.273095);
  const TimedPoses& estimate = Poses("lever_arm/body_estimate.tum");
  const TimedPoses& truth = Poses("lever_arm/prism_groundtruth.tum");
  const Evaluation of_truth = Evaluate(estimate, truth, options);
  EXPECT_EQ(of_truth.pairs.size(), 543u);
  EXPECT_NEAR(of_truth.absolute.translation_m.rmse, 0.0350767, 1e-7);
  options.association.rule = AssociationRule::kInterpolateEstimate;
  const Evaluation of_estimate = Evaluate(estimate, truth, options);
  EXPECT_EQ(of_estimate.pairs.size(), 1090u);
  EXPECT_NEAR(of_estimate.absolute.translation_m.rmse, 0.0299675, 1e-7);
}

}  // namespace
}  // namespace trajlo::testing
