// SPDX-License-Identifier: MIT
#include "core/graph/graph_files.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/io/errors.h"
#include "core/io/ply_reader.h"
#include "tests/core/graph/solved_windows.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

using nlohmann::json;

Eigen::MatrixXd MatrixOf(const json& rows) {
  Eigen::MatrixXd matrix(rows.size(), rows.at(0).size());
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      matrix(r, c) = rows.at(static_cast<std::size_t>(r)).at(static_cast<std::size_t>(c));
    }
  }
  return matrix;
}

Eigen::VectorXd VectorOf(const json& values) {
  const std::vector<double> numbers = values;
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

PointTable ReadTable(const std::filesystem::path& path) {
  const std::string text = ReadFile(path);
  FileBytes bytes(text.size());
  std::copy(text.begin(), text.end(), bytes.data());
  return ReadPly(path, std::move(bytes));
}

std::vector<double> Values(const PointTable& table, const char* name) {
  std::vector<double> values;
  auto note = [&](std::size_t, double value) { values.push_back(value); };
  VisitColumnAs<double>(table, *table.Find(name), 0, table.count, note);
  return values;
}

class GraphFiles : public ::testing::Test {
 protected:
  GraphFiles() : window_(SolvedWindows().back()), graph_(MakeWindowGraph(window_)) {
    WriteGraphFiles(folder_ / "windows", 43, window_);
    json_ = json::parse(ReadFile(folder_ / "windows/000043.json"));
  }
  TempFolder folder_;
  Window window_;
  WindowGraph graph_;
  json json_;
};

TEST_F(GraphFiles, HaveAllNumbersToTheLastBit) {
  EXPECT_EQ(json_["index"], 43);
  EXPECT_EQ(json_["points"], "000043.ply");
  EXPECT_EQ(MatrixOf(json_["H"]), graph_.equations.H);
  EXPECT_EQ(VectorOf(json_["g"]), graph_.equations.g);
  EXPECT_EQ(json_["cost"]["registration"].get<double>(), graph_.equations.cost.registration);
  EXPECT_EQ(json_["times_ns"].size(), json_["poses"].size());
  EXPECT_EQ(json_["times_ns"].back().get<std::int64_t>(), window_.EndNs());
  EXPECT_EQ(json_["kernel"], "cauchy");
  EXPECT_EQ(json_["segments"].size(), 5u);
  EXPECT_EQ(json_["motion"].size(), 4u);
  EXPECT_EQ(json_["motion"][0]["kind"], "white_noise_acceleration");
}

/// What somebody can do with the files alone: put the equations together again.
TEST_F(GraphFiles, AreEnoughToAssembleTheEquationsOfMotionAndPrior) {
  WindowNormalEquations sum;
  sum.SetZero(window_.size() + 1);
  for (const json& term : json_["motion"]) {
    sum.Add(term["first_pose"], MatrixOf(term["jacobian"]), VectorOf(term["residual"]));
  }
  sum.Add(0, MatrixOf(json_["prior"]["jacobian"]), VectorOf(json_["prior"]["residual"]));
  for (int k = 0; k < window_.size(); ++k) {
    sum.H.block<12, 12>(6 * k, 6 * k) +=
        graph_.segments[static_cast<std::size_t>(k)].registration.H;
  }
  EXPECT_LT((sum.H - MatrixOf(json_["H"])).norm(), 1e-12 * sum.H.norm());
}

TEST_F(GraphFiles, ThePointsHaveWhatTheirFactorsNeed) {
  const PointTable table = ReadTable(folder_ / "windows/000043.ply");
  EXPECT_EQ(table.damage, "");
  ASSERT_EQ(table.count, graph_.points.size());
  const std::vector<double> x = Values(table, "x"), y = Values(table, "y"), z = Values(table, "z"),
                            nx = Values(table, "nx"), ny = Values(table, "ny"),
                            nz = Values(table, "nz"), offset_m = Values(table, "offset_m"),
                            distance_m = Values(table, "distance_m"),
                            weight = Values(table, "weight"), segment = Values(table, "segment"),
                            kernel_weight = Values(table, "kernel_weight"),
                            information = Values(table, "information");
  for (std::size_t i = 0; i < table.count; ++i) {
    EXPECT_NEAR(nx[i] * x[i] + ny[i] * y[i] + nz[i] * z[i] - offset_m[i], distance_m[i], 1e-12);
    const double sigma_m = json_["segments"].at(static_cast<std::size_t>(segment[i]))["sigma_m"];
    EXPECT_NEAR(weight[i] * kernel_weight[i] / (sigma_m * sigma_m), information[i],
                1e-9 * information[i]);
  }
}

TEST(GraphFilesErrors, AFolderThatCannotBeMadeIsTold) {
  const TempFolder folder;
  WriteFile(folder / "windows", "somebody's");
  EXPECT_THROW(WriteGraphFiles(folder / "windows", 0, {}), OutputError);
}

TEST(GraphFilesErrors, NamesSortLikeTheirNumbers) {
  EXPECT_EQ(GraphName(7), "000007");
  EXPECT_EQ(GraphName(1234567), "1234567");
}

}  // namespace
}  // namespace trajlo::testing
