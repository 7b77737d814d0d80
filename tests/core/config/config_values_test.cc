// SPDX-License-Identifier: MIT
// What each type of option accepts and refuses.
#include <gmock/gmock.h>

#include "tests/core/config/config_testing.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using trajlo::testing::Loaded;
using trajlo::testing::LoadingError;
using trajlo::testing::Overridden;
using trajlo::testing::OverrideError;

TEST(ConfigValues, OutOfRangeNamesTheLineAndTheRange) {
  EXPECT_THAT(LoadingError("window:\n  segments: 0"),
              AllOf(StartsWith("my.yaml:2:13: 'window.segments' must be"), HasSubstr("1 to 100"),
                    HasSubstr("found '0'")));
  EXPECT_THAT(LoadingError("map: {voxel_size_m: -0.8}"),
              AllOf(HasSubstr("from 0.01 to 20.0"), HasSubstr("'-0.8'")));
}

TEST(ConfigValues, NumbersAreStrict) {
  for (const char* text : {"4x", "4.5", "", "0x4", "1e3", "99999999999999999999", "\"\"", "[4]"}) {
    EXPECT_NE(OverrideError(std::string("window.segments=") + text), "") << text;
  }
  for (const char* text : {"1,5", "nan", ".nan", "inf", "1e999", "one", "0.1m", "--1"}) {
    EXPECT_NE(OverrideError(std::string("map.voxel_size_m=") + text), "") << text;
  }
  EXPECT_EQ(Overridden("window.segments=+5").odometry.window.segments, 5);
  EXPECT_EQ(Overridden("map.voxel_size_m=5e-1").odometry.map.finest.voxel_size_m, 0.5);
  EXPECT_EQ(Overridden("map.voxel_size_m=1").odometry.map.finest.voxel_size_m, 1.0);
}

TEST(ConfigValues, Flags) {
  EXPECT_FALSE(Overridden("expert.marginalization.enabled=off").odometry.marginalization.enabled);
  EXPECT_TRUE(Overridden("expert.marginalization.first_estimate_jacobians=yes")
                  .odometry.marginalization.first_estimate_jacobians);
  EXPECT_THAT(OverrideError("expert.marginalization.enabled=1"),
              HasSubstr("must be true or false"));
}

TEST(ConfigValues, ChoicesListTheirNames) {
  EXPECT_THAT(OverrideError("solver.kind=cerres"),
              AllOf(HasSubstr("ceres | gauss_newton"), HasSubstr("did you mean 'ceres'?")));
  EXPECT_FALSE(Overridden("input.point_time=none").input.use_point_times.Of(0));
  EXPECT_EQ(Overridden("input.time_unit=ms").input.time_unit.Of(0), TimeUnit::kMilliseconds);
}

const std::vector<SE3>& Extrinsics(const RunConfig& config) {
  return config.odometry.segmenter.T_body_lidar;
}

TEST(ConfigExtrinsics, QuaternionMatrixAndDefaults) {
  const RunConfig config = Loaded(R"(
sensor:
  T_body_lidar:
    - translation_m: [-0.05, 0, 0.055]
    - {rotation: [0, 0, 0.70710678, 0.70710678]}
    - matrix:
        - [0, 0, 1, -0.35]
        - [0, 1, 0, 0.03]
        - [-1, 0, 0, -0.05]
    - matrix: [1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 0, 0, 0, 1]
)");
  ASSERT_EQ(Extrinsics(config).size(), 4u);
  EXPECT_EQ(Extrinsics(config)[0].t, Eigen::Vector3d(-0.05, 0, 0.055));
  EXPECT_EQ(Extrinsics(config)[0].q.w(), 1.0);
  EXPECT_NEAR(Extrinsics(config)[1].q.norm(), 1.0, 1e-15);
  const Eigen::Vector3d p = Extrinsics(config)[2] * Eigen::Vector3d(1, 2, 3);
  EXPECT_NEAR((p - Eigen::Vector3d(2.65, 2.03, -1.05)).norm(), 0.0, 1e-12);
  EXPECT_EQ(Extrinsics(config)[3].t, Eigen::Vector3d(4, 5, 6));
}

TEST(ConfigExtrinsics, AMatrixMayBeAFlatListRowByRow) {
  const std::string rows = "0, 0, 1, -0.35, 0, 1, 0, 0.03, -1, 0, 0, -0.05";
  const std::string whole = "[" + rows + ", 0, 0, 0, 1]";
  for (const std::string& value : {"[[" + rows + "], " + whole + "]", "[[" + rows + "]]",
                                   "[" + rows + "]", whole, "{matrix: " + whole + "}"}) {
    const RunConfig config = Overridden("sensor.T_body_lidar=" + value);
    EXPECT_EQ(Extrinsics(config).size(), value.find("], [") == std::string::npos ? 1u : 2u);
    for (const SE3& T : Extrinsics(config)) {
      const Eigen::Vector3d p = T * Eigen::Vector3d(1, 2, 3);
      EXPECT_NEAR((p - Eigen::Vector3d(2.65, 2.03, -1.05)).norm(), 0.0, 1e-12) << value;
    }
  }
}

TEST(ConfigExtrinsics, MistakesAreExplained) {
  const auto problem = [](const std::string& value) {
    return OverrideError("sensor.T_body_lidar=" + value);
  };
  EXPECT_THAT(problem("[{translation_m: [1, 2]}]"), HasSubstr("needs 3 numbers"));
  EXPECT_THAT(problem("[{translation_m: [1, 2, x]}]"), HasSubstr("found 'x'"));
  EXPECT_THAT(problem("[{translation_m: [1, 2, .inf]}]"), HasSubstr("finite number"));
  EXPECT_THAT(problem("[{rotation: [1, 1, 0, 0]}]"), HasSubstr("unit quaternion"));
  EXPECT_THAT(problem("[{rotation: [1, 0, 0]}]"), HasSubstr("found 3"));
  EXPECT_THAT(problem("[{matrix: [1, 2, 3]}]"), HasSubstr("3 or 4 rows"));
  EXPECT_THAT(problem("[{matrix: [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]}]"),
              HasSubstr("not a rotation"));
  EXPECT_THAT(problem("[{matrix: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0]}]"),
              HasSubstr("it mirrors, its determinant is -1"));
  EXPECT_THAT(problem("[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 4, 5, 6, 1]"),
              AllOf(HasSubstr("last row"), HasSubstr("row by row")));
  EXPECT_THAT(problem("[1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1]"), HasSubstr("found 11 numbers"));
  EXPECT_THAT(problem("[1, 0, 0, 4, 0, 1, 0, 5, 0, 0, 1, 6, 7]"), HasSubstr("found 13 numbers"));
  EXPECT_THAT(problem("[{translation: [1, 2, 3]}]"), HasSubstr("unexpected 'translation'"));
  EXPECT_THAT(problem("3"), HasSubstr("expected a list"));
}

TEST(ConfigValues, APerLidarOptionTakesAValueForAllOrAListWithOneForEach) {
  RunConfig config = Overridden("input.stamp_at=[end,start],input.topics=[/a,/b]");
  EXPECT_EQ(config.input.stamp_at.Of(0), StampAt::kEnd);
  EXPECT_EQ(config.input.stamp_at.Of(1), StampAt::kStart);
  EXPECT_EQ(config.input.stamp_at.Of(7), StampAt::kStart);
  EXPECT_EQ(config.input.topics, (std::vector<std::string>{"/a", "/b"}));
  RunConfig back;
  LoadConfigText(DumpConfig(config), "dump", &back);
  EXPECT_EQ(back.input.topics, config.input.topics);
  EXPECT_EQ(back.input.stamp_at.values, config.input.stamp_at.values);
  ApplyOverrides("input.topics=/c,input.stamp_at=auto", &back);
  EXPECT_EQ(back.input.topics, std::vector<std::string>{"/c"});
  ApplyOverrides("input.topics=", &back);
  EXPECT_TRUE(back.input.topics.empty());
  EXPECT_THROW(ApplyOverrides("input.stamp_at=[]", &back), ConfigError);
  EXPECT_THROW(ApplyOverrides("input.stamp_at=[end,middle]", &back), ConfigError);
}

}  // namespace
}  // namespace trajlo
