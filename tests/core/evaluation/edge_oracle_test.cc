// SPDX-License-Identifier: MIT
// Files with defects: accepted, or refused with a message, but never wrong numbers.
#include "core/evaluation/evaluation_error.h"
#include "core/io/errors.h"
#include "tests/core/evaluation/evaluation_testing.h"

namespace trajlo::testing {
namespace {

using Json = nlohmann::json;

struct Outcome {
  std::optional<Evaluation> evaluation;
  std::string error;
  std::vector<std::string> warnings;
};

Outcome EvaluateCase(const Json& expected) {
  Outcome outcome;
  EvaluationOptions options = EvoOptions(AlignmentOf(expected["alignment"]));
  RelativeErrorOptions frame;
  frame.unit = DeltaUnit::kFrames;
  options.relative.push_back(frame);
  try {
    const auto read = [&](const std::string& name) {
      return OrderByTime(
          ReadTrajectory(EvaluationData() / name, TrajectoryFormat::kAuto, &outcome.warnings), name,
          RepeatedStamps::kFirst, &outcome.warnings);
    };
    const TimedPoses truth = read(expected["ref"]);
    const TimedPoses estimate = read("edge/" + expected["file"].get<std::string>());
    outcome.evaluation = Evaluate(estimate, truth, options);
  } catch (const InputError& error) {
    outcome.error = error.what();
  } catch (const EvaluationError& error) {
    outcome.error = error.what();
  }
  return outcome;
}

/// `rounding` is what the file itself lost when it was written.
void ExpectNumbers(const Json& evo, const Evaluation& evaluation, double rounding) {
  EXPECT_EQ(evaluation.pairs.size(), evo["poses_associated"].get<std::size_t>());
  const auto compare = [&](const char* name, const ErrorStatistics& statistics, double absolute) {
    if (!evo.contains(name)) return;
    ExpectStatistics(
        statistics, [&](const char* key) { return evo[name][key].get<double>(); },
        std::max(1e-9, rounding), absolute);
  };
  compare("ape_trans", evaluation.absolute.translation_m, std::max(1e-12, rounding));
  compare("ape_angle_deg", evaluation.absolute.rotation_deg, std::max(1e-6, rounding));
  compare("rpe_trans_1f", evaluation.relative[0].statistics.translation_m,
          std::max(1e-12, rounding));
}

/// What a file itself lost when it was written with few digits.
double RoundingOf(const std::string& file) {
  if (file == "quaternion_not_normalised.tum") return 1e-6;
  if (file == "kitti_rotation_not_orthonormal.txt") return 2e-6;
  return 0.0;
}

class EdgeOracle : public OracleTest {};

TEST_F(EdgeOracle, EveryDefectIsTreatedAsRequired) {
  const Json cases = ReadJson("edge.json")["cases"];
  std::map<std::string, Json> evo;
  for (const Json& c : cases) evo[c["id"]] = c["evo"];
  std::size_t compared = 0;
  for (const Json& expected : cases) {
    const std::string id = expected["id"], required = expected["required"];
    SCOPED_TRACE(id);
    const Outcome outcome = EvaluateCase(expected);
    const double rounding = RoundingOf(expected["file"]);
    const bool kitti = expected["format"] == "kitti";
    if (required == "evo_numbers") {
      ASSERT_TRUE(outcome.evaluation) << outcome.error;
      ExpectNumbers(evo[id], *outcome.evaluation, rounding);
    } else if (required == "same_as_base") {
      ASSERT_TRUE(outcome.evaluation) << outcome.error;
      ExpectNumbers(evo[kitti ? "kitti_base.txt" : "base.tum"], *outcome.evaluation, rounding);
    } else if (required == "report_duplicates") {
      // The first one counts.
      ASSERT_TRUE(outcome.evaluation) << outcome.error;
      EXPECT_THAT(outcome.warnings, ::testing::Contains(::testing::HasSubstr("repeat an earlier")));
      const bool sparse = id.find("sparse") != std::string::npos;
      const bool first_wrong = id.find("first_wrong") != std::string::npos;
      ExpectNumbers(evo[sparse        ? "sparse_reference.tum"
                        : first_wrong ? id
                                      : "base.tum"],
                    *outcome.evaluation, rounding);
    } else if (required == "skip_line_or_error") {
      ASSERT_TRUE(outcome.evaluation) << outcome.error;
      EXPECT_THAT(outcome.warnings, ::testing::Contains(::testing::HasSubstr("line 31")));
      ExpectNumbers(evo["line_removed_reference.tum"], *outcome.evaluation, rounding);
    } else if (required == "same_as_base_or_error") {
      EXPECT_TRUE(outcome.evaluation || !outcome.error.empty());
      if (outcome.evaluation) {
        ExpectNumbers(evo["kitti_base.txt"], *outcome.evaluation, rounding);
      }
    } else {
      EXPECT_THAT(required, ::testing::AnyOf("error", "error_or_warning", "error_or_skip_line"));
      EXPECT_FALSE(outcome.evaluation);
      EXPECT_NE(outcome.error, "");
    }
    ++compared;
  }
  EXPECT_EQ(compared, cases.size());
}

TEST_F(EdgeOracle, MessagesSayWhatIsWrong) {
  const auto error_of = [](const char* file, const char* ref = "edge/gt.tum") {
    return EvaluateCase({{"file", file}, {"ref", ref}, {"alignment", "se3"}}).error;
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of("no_overlap.tum"),
              ::testing::AllOf(HasSubstr("the estimate spans"), HasSubstr("time_offset_s")));
  EXPECT_THAT(error_of("nanosecond_stamps.tum"), HasSubstr("ns, us or ms"));
  EXPECT_THAT(error_of("just_outside_max_diff.tum"), HasSubstr("within 0.01 s"));
  EXPECT_THAT(error_of("text_in_field.tum"), HasSubstr("text_in_field.tum: line "));
  EXPECT_THAT(error_of("collinear.tum", "edge/collinear_gt.tum"), HasSubstr("straight line"));
  EXPECT_THAT(error_of("kitti_one_line_short.txt", "edge/kitti_gt.txt"),
              ::testing::AllOf(HasSubstr("59"), HasSubstr("60")));
  EXPECT_THAT(error_of("empty.tum"), HasSubstr("no poses"));
}

TEST_F(EdgeOracle, AShortPathHasNoKittiErrorsAndSaysSo) {
  const Outcome outcome = EvaluateCase(
      {{"file", "kitti_base.txt"}, {"ref", "edge/kitti_gt.txt"}, {"alignment", "se3"}});
  ASSERT_TRUE(outcome.evaluation);
  EXPECT_FALSE(outcome.evaluation->kitti);
  EXPECT_THAT(outcome.evaluation->kitti_reason, ::testing::HasSubstr("too short"));
}

}  // namespace
}  // namespace trajlo::testing
