// SPDX-License-Identifier: MIT
// Against the scripts of the TUM RGB-D benchmark.
#include <limits>

#include "core/io/scan_stamps.h"
#include "tests/core/evaluation/evaluation_testing.h"

namespace trajlo::testing {
namespace {

class TumRgbdOracle : public OracleTest {
 protected:
  const TimedPoses& estimate() const { return Poses("evo/fr2_desk_ORB.txt"); }
  // One stamp of it is there twice, and the scripts keep the last pose.
  const TimedPoses& truth() const {
    return Poses("evo/fr2_desk_groundtruth.txt", RepeatedStamps::kLast);
  }
};

void ExpectCase(const nlohmann::json& expected, const PoseErrorStatistics& statistics) {
  ExpectStatistics(
      statistics.translation_m,
      [&](const char* name) { return expected["translation_m"][name].get<double>(); }, 1e-9, 0.0);
  // The scripts take the angle from the arc cosine of the trace.
  if (!expected.contains("rotation_deg")) return;
  ExpectStatistics(
      statistics.rotation_deg,
      [&](const char* name) { return expected["rotation_deg"][name].get<double>(); }, 0.0, 1e-9);
}

TEST_F(TumRgbdOracle, RelativeErrorsOverSecondsAgree) {
  std::size_t compared = 0;
  const nlohmann::json cases = ReadJson("tum_rgbd.json")["cases"];
  for (const nlohmann::json& expected : cases) {
    if (expected.value("delta_unit", "") != "s") continue;
    SCOPED_TRACE(expected["id"].get<std::string>());
    EvaluationOptions options = EvoOptions(AlignmentKind::kNone);
    options.association.max_time_difference_s = 2.0 * TypicalPeriod(truth().t_ns);
    options.time_offset_s = expected["offset"];
    // Two stamps then lie in the very middle of two true poses, and the scripts' search happens to
    // take the later one; a microsecond more does the same here and changes no other pair.
    if (options.time_offset_s != 0.0) options.time_offset_s += 1e-6;
    RelativeErrorOptions relative;
    relative.delta = expected["delta"];
    relative.unit = DeltaUnit::kSeconds;
    relative.tolerance = std::numeric_limits<double>::infinity();
    options.relative.push_back(relative);
    const RelativeEvaluation result = Evaluate(estimate(), truth(), options).relative.front();
    ASSERT_EQ(result.pieces, expected["n_errors"].get<std::size_t>());
    ExpectCase(expected, result.statistics);
    ++compared;
  }
  EXPECT_EQ(compared, 3u);
}

// The scripts count frames of the file, evo and this library frames that have a partner; the
// pieces are made here, and the errors compared.
TEST_F(TumRgbdOracle, RelativeErrorsOverFramesOfTheFileAgree) {
  PoseAssociationOptions nearest;
  nearest.rule = AssociationRule::kNearest;
  nearest.max_time_difference_s = 2.0 * TypicalPeriod(truth().t_ns);
  const std::vector<PosePair> pairs = Associate(estimate(), truth(), 0, nearest);
  std::map<std::size_t, std::size_t> pair_of;
  for (std::size_t k = 0; k < pairs.size(); ++k) pair_of[pairs[k].index] = k;
  std::size_t compared = 0;
  const nlohmann::json cases = ReadJson("tum_rgbd.json")["cases"];
  for (const nlohmann::json& expected : cases) {
    if (expected.value("delta_unit", "") != "f") continue;
    SCOPED_TRACE(expected["id"].get<std::string>());
    IndexPairs pieces;
    // All but those that end at the last pose.
    for (const auto& [i, j] : PairsOverFrames(estimate().size() - 1, expected["delta"], true)) {
      if (pair_of.count(i) && pair_of.count(j)) pieces.push_back({pair_of[j], pair_of[i]});
    }
    ASSERT_EQ(pieces.size(), expected["n_errors"].get<std::size_t>());
    const PoseErrors errors = RelativeErrors(pairs, pieces, true);
    PoseErrorStatistics statistics;
    statistics.translation_m = ComputeStatistics(errors.translation_m);
    statistics.rotation_deg = ComputeStatistics(errors.rotation_deg);
    ExpectCase(expected, statistics);
    ++compared;
  }
  EXPECT_EQ(compared, 2u);
}

TEST_F(TumRgbdOracle, TheAbsoluteErrorAgrees) {
  std::size_t compared = 0;
  const nlohmann::json cases = ReadJson("tum_rgbd.json")["cases"];
  for (const nlohmann::json& expected : cases) {
    if (!expected.contains("max_difference")) continue;
    SCOPED_TRACE(expected["id"].get<std::string>());
    EvaluationOptions options = EvoOptions(AlignmentKind::kSe3);
    options.association.rule = AssociationRule::kOneToOne;
    options.association.max_time_difference_s = expected["max_difference"];
    options.time_offset_s = expected["offset"];
    const Evaluation evaluation = Evaluate(estimate(), truth(), options);
    ASSERT_EQ(evaluation.pairs.size(), expected["n_errors"].get<std::size_t>());
    ExpectCase(expected, evaluation.absolute);
    ++compared;
  }
  EXPECT_EQ(compared, 3u);
}

}  // namespace
}  // namespace trajlo::testing
