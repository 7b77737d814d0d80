// SPDX-License-Identifier: MIT
// Against evo: every run of its expected numbers, none left out. They are those of 1.36.5; 1.38.1
// says the same, but for pieces of path in a row, whose numbers are in fixtures/.
#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"
#include "tests/core/evaluation/evaluation_testing.h"

namespace trajlo::testing {
namespace {

constexpr std::size_t kRuns = 403;

double Number(const CsvRow& row, const std::string& name) { return std::stod(row.at(name)); }

EvaluationOptions OptionsOf(const CsvRow& row) {
  EvaluationOptions options = EvoOptions(AlignmentOf(row.at("alignment")));
  if (Number(row, "n_to_align") > 0) {
    options.alignment.first_pairs = std::stoul(row.at("n_to_align"));
  }
  if (!row.at("t_max_diff").empty()) {
    options.association.max_time_difference_s = Number(row, "t_max_diff");
    options.time_offset_s = Number(row, "t_offset");
  }
  if (row.at("metric") == "rpe") {
    RelativeErrorOptions relative;
    relative.delta = Number(row, "delta");
    const std::string& unit = row.at("delta_unit");
    relative.unit = unit == "m"   ? DeltaUnit::kMetres
                    : unit == "f" ? DeltaUnit::kFrames
                                  : DeltaUnit::kDegrees;
    EXPECT_EQ(unit, DeltaUnitName(relative.unit));
    relative.all_pairs = row.at("all_pairs") == "true";
    relative.along_truth = row.at("pairs_from_reference") == "true";
    if (!row.at("rel_delta_tol").empty()) relative.tolerance = Number(row, "rel_delta_tol");
    options.relative.push_back(relative);
  }
  return options;
}

const ErrorStatistics& StatisticsOf(const CsvRow& row, const Evaluation& evaluation) {
  const PoseErrorStatistics& s =
      row.at("metric") == "rpe" ? evaluation.relative.front().statistics : evaluation.absolute;
  const std::string& relation = row.at("pose_relation");
  if (relation == "trans_part") return s.translation_m;
  if (relation == "angle_deg") return s.rotation_deg;
  if (relation == "rot_part") return s.rotation_part;
  if (relation == "full") return s.full;
  EXPECT_EQ(relation, "point_distance");
  return s.point_distance_m;
}

/// The same evaluation serves all pose relations.
const Evaluation& EvaluationOf(const CsvRow& row) {
  static std::map<std::string, Evaluation> cache;
  std::string key;
  for (const char* name : {"dataset", "metric", "alignment", "n_to_align", "t_max_diff", "t_offset",
                           "delta", "delta_unit", "all_pairs", "pairs_from_reference"}) {
    key += row.at(name) + "|";
  }
  const auto found = cache.find(key);
  if (found != cache.end()) return found->second;
  return cache[key] = Evaluate(Poses(row.at("est")), Poses(row.at("ref")), OptionsOf(row));
}

class EvoOracle : public OracleTest {};

/// What evo 1.38.1 says where it differs from 1.36.5, which left out the first piece of path.
void TakeNewerNumbers(std::vector<CsvRow>* rows) {
  std::map<std::string, CsvRow> newer;
  for (const CsvRow& row : ReadCsv(TRAJLO_TEST_DIR "/fixtures/evo_path_pieces.csv")) {
    newer[row.at("id")] = row;
  }
  for (CsvRow& row : *rows) {
    const bool differs = row["delta_unit"] == "m" && row["all_pairs"] == "false";
    ASSERT_EQ(differs, newer.count(row["id"]) == 1) << row["id"];
    if (!differs) continue;
    for (const auto& [name, value] : newer[row["id"]]) row[name] = value;
  }
}

TEST_F(EvoOracle, EveryRunAgrees) {
  std::vector<CsvRow> rows = ReadCsv(EvaluationData() / "expected/evo.csv");
  ASSERT_EQ(rows.size(), kRuns);
  ASSERT_NO_FATAL_FAILURE(TakeNewerNumbers(&rows));
  for (const CsvRow& row : rows) {
    SCOPED_TRACE(row.at("id"));
    const Evaluation& evaluation = EvaluationOf(row);
    EXPECT_EQ(evaluation.pairs.size(), std::stoul(row.at("poses_associated")));
    const ErrorStatistics& statistics = StatisticsOf(row, evaluation);
    ASSERT_EQ(statistics.count, std::stoul(row.at("n_errors")));
    if (!row.at("error").empty()) {
      EXPECT_NE(evaluation.relative.front().reason, "");
      continue;
    }
    const bool angle = row.at("pose_relation") == "angle_deg";
    const bool few = row.at("n_to_align") == "10";  // Three points on a line, but for 1e-7 m².
    double relative = few ? 1e-7 : 1e-9;
    double absolute = 1e-12;
    // Rotations of KITTI files are orthonormal to 1e-6 only, and evo goes through quaternions.
    if (angle) absolute = row.at("format") == "kitti" ? 5e-6 : 1e-6;
    ExpectStatistics(
        statistics,
        [&](const char* name) {
          // What is zero but for rounding: the first pose after origin alignment.
          const double value = Number(row, name);
          if (std::string(name) == "min" && row.at("alignment") == "origin" && value < 1e-6) {
            EXPECT_LT(statistics.min, 1e-6);
            return statistics.min;
          }
          return value;
        },
        relative, absolute);
    if (angle) continue;
    EXPECT_NEAR(statistics.sse, Number(row, "sse"), 2 * relative * Number(row, "sse"));
  }
}

TEST_F(EvoOracle, TheAlignmentsAreThoseThatEvoApplies) {
  std::map<std::string, CsvRow> runs;
  for (const CsvRow& row : ReadCsv(EvaluationData() / "expected/evo.csv")) runs[row.at("id")] = row;
  std::size_t compared = 0;
  for (const CsvRow& row : ReadCsv(EvaluationData() / "expected/evo_alignments.csv")) {
    SCOPED_TRACE(row.at("id"));
    ASSERT_TRUE(runs.count(row.at("id")));
    const CsvRow& run = runs[row.at("id")];
    const Alignment& alignment = EvaluationOf(run).alignment;
    const double tolerance = run.at("n_to_align") == "10" ? 1e-5 : 1e-9;
    EXPECT_NEAR(alignment.scale, Number(row, "scale"), tolerance);
    // Of "scale" the file has the whole similarity, of which evo applies the scale.
    for (int i = 0; i < 3 && run.at("alignment") != "scale"; ++i) {
      const std::string name = "m" + std::to_string(i);
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(alignment.scale * alignment.R(i, j), Number(row, name + std::to_string(j)),
                    tolerance);
      }
      const double t = Number(row, name + "3");
      EXPECT_NEAR(alignment.t[i], t, tolerance * std::max(1.0, std::abs(t)));
    }
    ++compared;
  }
  EXPECT_GT(compared, 40u);
}

TEST_F(EvoOracle, EveryPairOfV102HasItsError) {
  const std::vector<CsvRow> rows = ReadCsv(EvaluationData() / "expected/evo_V102_errors_se3.csv");
  const Evaluation evaluation = Evaluate(Poses("evo/V102.txt"), Poses("evo/V102_groundtruth.csv"),
                                         EvoOptions(AlignmentKind::kSe3));
  ASSERT_EQ(evaluation.pairs.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(evaluation.errors.translation_m[i], Number(rows[i], "ape_trans_m"), 1e-9);
    EXPECT_NEAR(evaluation.errors.rotation_deg[i], Number(rows[i], "ape_angle_deg"), 1e-8);
  }
}

TEST_F(EvoOracle, Fr2DeskIsPairedAsEvoPairsIt) {
  const std::vector<CsvRow> rows =
      ReadCsv(EvaluationData() / "expected/evo_fr2_desk_association.csv");
  PoseAssociationOptions options;
  options.rule = AssociationRule::kNearest;
  const std::vector<PosePair> pairs =
      Associate(Poses("evo/fr2_desk_ORB.txt"), Poses("evo/fr2_desk_groundtruth.txt"), 0, options);
  ASSERT_EQ(pairs.size(), rows.size());
  const TimedPoses& truth = Poses("evo/fr2_desk_groundtruth.txt");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(Seconds(pairs[i].t_ns), Number(rows[i], "est_stamp_s"), 1e-6);
    const std::size_t t = Nearest(truth.t_ns, Nanoseconds(Number(rows[i], "ref_stamp_s")));
    EXPECT_EQ(pairs[i].truth.translation(), truth.T_world_body[t].translation()) << i;
  }
}

}  // namespace
}  // namespace trajlo::testing
