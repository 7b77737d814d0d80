// SPDX-License-Identifier: MIT
// Every configuration that the project comes with can be loaded.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> DatasetConfigs() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(TRAJLO_CONFIG_DIR) / "datasets")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class DatasetConfig : public ::testing::TestWithParam<fs::path> {};
INSTANTIATE_TEST_SUITE_P(All, DatasetConfig, ::testing::ValuesIn(DatasetConfigs()),
                         [](const auto& test) { return test.param.stem().string(); });

TEST_P(DatasetConfig, LoadsAloneAndOverTheGeneralOnes) {
  RunConfig config;
  LoadConfigFile(GetParam(), &config);
  CheckConfig(config);
  for (const char* general : {"indoor.yaml", "outdoor.yaml"}) {
    RunConfig both;
    LoadConfigFile(fs::path(TRAJLO_CONFIG_DIR) / general, &both);
    LoadConfigFile(GetParam(), &both);
    CheckConfig(both);
  }
}

TEST_P(DatasetConfig, SaysWhereItsValuesAreFrom) {
  EXPECT_THAT(testing::ReadFile(GetParam()), ::testing::HasSubstr("Source"));
}

TEST_P(DatasetConfig, PlacesAllItsLidarsOrSaysThatItDoesNot) {
  RunConfig config;
  LoadConfigFile(GetParam(), &config);
  const std::size_t lidars = config.input.topics.size();
  if (lidars < 2 || config.odometry.segmenter.T_body_lidar.size() == lidars) return;
  EXPECT_THAT(testing::ReadFile(GetParam()), ::testing::HasSubstr("INCOMPLETE BY ITSELF"));
}

RunConfig Load(const std::string& name) {
  RunConfig config;
  LoadConfigFile(fs::path(TRAJLO_CONFIG_DIR) / "datasets" / name, &config);
  return config;
}

TEST(DatasetConfigs, OfNtuViralAgreeAboutTheRig) {
  const RunConfig both = Load("ntu_viral.yaml");
  const RunConfig horizontal = Load("ntu_viral_horizontal.yaml");
  const RunConfig vertical = Load("ntu_viral_vertical.yaml");
  const auto& T = both.odometry.segmenter.T_body_lidar;
  ASSERT_EQ(T.size(), 2u);
  EXPECT_EQ(horizontal.odometry.segmenter.T_body_lidar[0].t, T[0].t);
  EXPECT_EQ(vertical.odometry.segmenter.T_body_lidar[0].t, T[1].t);
  EXPECT_EQ(vertical.odometry.segmenter.T_body_lidar[0].q.coeffs(), T[1].q.coeffs());
  EXPECT_EQ(horizontal.input.topics[0], "/os1_cloud_node1/points");
  EXPECT_EQ(vertical.input.topics[0], "/os1_cloud_node2/points");
  EXPECT_EQ(both.input.stamp_at.Of(1), StampAt::kEnd);
}

}  // namespace
}  // namespace trajlo
