// SPDX-License-Identifier: MIT
// Against the KITTI odometry development kit.
#include "tests/core/evaluation/evaluation_testing.h"

namespace trajlo::testing {
namespace {

KittiErrors ErrorsOf(const std::string& estimate, const std::string& truth) {
  return ComputeKittiErrors(Associate(Poses(estimate), Poses(truth), 0, {}));
}

double Percent(const nlohmann::json& expected) { return 100.0 * expected["t_err"].get<double>(); }
double DegPerM(const nlohmann::json& expected) {
  return expected["r_err"].get<double>() * 180.0 / M_PI;
}

class KittiOracle : public OracleTest {};

TEST_F(KittiOracle, EveryIncludedSequenceAgreesInDoubleAndInSinglePrecision) {
  std::size_t compared = 0;
  const nlohmann::json cases = ReadJson("kitti_devkit.json")["sequences"];
  for (const nlohmann::json& expected : cases) {
    // The truth against itself and the LiDAR's frame have tests of their own.
    const std::string id = expected["id"];
    if (!expected["included"].get<bool>() || expected["est"] == expected["ref"] ||
        id.find("lidar") != std::string::npos) {
      continue;
    }
    SCOPED_TRACE(id);
    const KittiErrors errors = ErrorsOf(expected["est"], expected["ref"]);
    ASSERT_EQ(errors.segments.size(), expected["n_segments"].get<std::size_t>());
    const nlohmann::json& exact = expected["all_double"];
    EXPECT_NEAR(errors.translation_percent, Percent(exact), 1e-9 * Percent(exact));
    EXPECT_NEAR(errors.rotation_deg_per_m, DegPerM(exact), 1e-7 * DegPerM(exact));
    for (const char* variant : {"kit_float", "kit_segments_double_mean"}) {
      EXPECT_NEAR(errors.translation_percent, Percent(expected[variant]), 2e-5);
      EXPECT_NEAR(errors.rotation_deg_per_m, DegPerM(expected[variant]), 5e-6);
    }
    for (const nlohmann::json& length : expected["per_length"]) {
      const auto& of_length = errors.per_length.at(length["length_m"].get<std::size_t>() / 100 - 1);
      ASSERT_EQ(of_length.segments, length["n"].get<std::size_t>());
      if (of_length.segments == 0) continue;
      const double percent = 100.0 * length["t_err_all_double"].get<double>();
      const double deg_per_m = length["r_err_all_double"].get<double>() * 180.0 / M_PI;
      EXPECT_NEAR(of_length.translation_percent, percent, 1e-9 * percent);
      EXPECT_NEAR(of_length.rotation_deg_per_m, deg_per_m, 1e-7 * deg_per_m);
    }
    ++compared;
  }
  EXPECT_EQ(compared, 15u);
}

TEST_F(KittiOracle, EverySegmentIsTheOneOfTheKit) {
  for (const std::string run : {"elastic_icp_07", "kiss_icp_04", "steam_icp_07"}) {
    SCOPED_TRACE(run);
    const std::string sequence = run.substr(run.size() - 2);
    const std::vector<CsvRow> rows =
        ReadCsv(EvaluationData() / ("expected/kitti_segments_" + run + ".csv"));
    const KittiErrors errors =
        ErrorsOf("kitti/" + run.substr(0, run.size() - 3) + "/" + sequence + "_poses.txt",
                 "kitti/gt/" + sequence + ".txt");
    ASSERT_EQ(errors.segments.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(errors.segments[i].first_frame, std::stoul(rows[i].at("first_frame")));
      EXPECT_EQ(errors.segments[i].length_m, std::stod(rows[i].at("length_m")));
      // The kit's single precision: 1e-7 of some 100 m, over at least 100 m.
      EXPECT_NEAR(errors.segments[i].translation_m_per_m, std::stod(rows[i].at("t_err_m_per_m")),
                  2e-6);
      EXPECT_NEAR(errors.segments[i].rotation_rad_per_m, std::stod(rows[i].at("r_err_rad_per_m")),
                  6e-6);
    }
  }
}

TEST_F(KittiOracle, PooledOverTenSequencesItIsTheNumberOfTheAuthors) {
  const nlohmann::json expected = ReadJson("kitti_devkit.json");
  const nlohmann::json& pooled = expected["pooled_over_00_01_02_04_to_10"]["steam_icp"];
  double percent = 0.0, deg_per_m = 0.0;
  std::size_t segments = 0;
  for (const nlohmann::json& sequence : expected["sequences"]) {
    if (sequence["method"] != "steam_icp") continue;
    const KittiErrors errors = ErrorsOf(sequence["est"], sequence["ref"]);
    const double n = static_cast<double>(errors.segments.size());
    segments += errors.segments.size();
    percent += n * errors.translation_percent;
    deg_per_m += n * errors.rotation_deg_per_m;
  }
  ASSERT_EQ(segments, pooled["n_segments"].get<std::size_t>());
  const double exact = pooled["t_err_percent_all_double"];
  EXPECT_NEAR(percent / static_cast<double>(segments), exact, 1e-9 * exact);
  const double exact_deg = pooled["r_err_deg_per_m_all_double"];
  EXPECT_NEAR(deg_per_m / static_cast<double>(segments), exact_deg, 1e-7 * exact_deg);
  EXPECT_NEAR(percent / static_cast<double>(segments), 0.521982, 2e-6);  // Their log file.
}

TEST_F(KittiOracle, AnExtrinsicTurnsTheLidarFrameIntoTheCameraFrame) {
  const nlohmann::json expected = ReadJson("kitti_devkit.json");
  const auto kiss_04 =
      std::find_if(expected["sequences"].begin(), expected["sequences"].end(),
                   [](const nlohmann::json& s) { return s["id"] == "kiss_icp 04"; });
  ASSERT_NE(kiss_04, expected["sequences"].end());
  std::ifstream file(EvaluationData() / "kitti/lidar_frame/calib_04.txt");
  std::string name;
  Eigen::Affine3d T_camera_lidar = Eigen::Affine3d::Identity();
  file >> name;
  for (int i = 0; i < 12; ++i) file >> T_camera_lidar.matrix()(i / 4, i % 4);
  ASSERT_EQ(name, "Tr:");

  const TimedPoses& lidar = Poses("kitti/lidar_frame/kiss_icp_04_lidar.txt");
  EvaluationOptions options;
  options.T_body_truth = T_camera_lidar.inverse(Eigen::Affine);
  const Evaluation converted = Evaluate(lidar, Poses("kitti/gt/04.txt"), options);
  ASSERT_TRUE(converted.kitti.has_value());
  const double percent = Percent((*kiss_04)["all_double"]);
  EXPECT_NEAR(converted.kitti->translation_percent, percent, 1e-6 * percent);
  EXPECT_NEAR(converted.kitti->rotation_deg_per_m, DegPerM((*kiss_04)["all_double"]), 1e-8);
  const Evaluation wrong = Evaluate(lidar, Poses("kitti/gt/04.txt"), {});
  EXPECT_NEAR(wrong.kitti->translation_percent, 141.078255, 1e-4);
  EXPECT_NEAR(wrong.kitti->rotation_deg_per_m, 0.0084693, 5e-6);
}

TEST_F(KittiOracle, TheTruthAgainstItselfIsZero) {
  const KittiErrors errors = ErrorsOf("kitti/gt/07.txt", "kitti/gt/07.txt");
  EXPECT_GT(errors.segments.size(), 100u);
  EXPECT_LT(errors.translation_percent, 1e-13);
}

}  // namespace
}  // namespace trajlo::testing
