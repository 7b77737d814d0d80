// SPDX-License-Identifier: MIT
#include "core/config/config.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/io/rig_yaml.h"
#include "tests/core/config/config_testing.h"
#include "tests/support/temp_folder.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using trajlo::testing::ConfigErrorOf;
using trajlo::testing::Loaded;
using trajlo::testing::LoadingError;
using trajlo::testing::Overridden;
using trajlo::testing::OverrideError;

TEST(Config, SetsWhatTheFileSaysAndKeepsTheRest) {
  const RunConfig config = Loaded("window:\n  segments: 7\nexpert: {map: {kind: kd_tree}}\n");
  EXPECT_EQ(config.odometry.window.segments, 7);
  EXPECT_EQ(config.odometry.map.finest.kind, MapKind::kKdTree);
  EXPECT_EQ(config.odometry.map.finest.voxel_size_m, RunConfig().odometry.map.finest.voxel_size_m);
}

TEST(Config, LaterFileOverridesEarlierOne) {
  RunConfig config = Loaded("window: {segments: 7}\nexpert: {solver: {max_rounds: 3}}");
  LoadConfigText("window: {segments: 2}", "second.yaml", &config);
  EXPECT_EQ(config.odometry.window.segments, 2);
  EXPECT_EQ(config.odometry.solver.max_rounds, 3);
}

TEST(Config, EmptyFileAndEmptySectionChangeNothing) {
  EXPECT_EQ(DumpConfig(Loaded("")), DumpConfig(RunConfig()));
  EXPECT_EQ(DumpConfig(Loaded("window:\n# segments: 3\nmap:\n")), DumpConfig(RunConfig()));
}

TEST(Config, UnknownKeyNamesFileLineColumnAndNearestKey) {
  EXPECT_THAT(LoadingError("map:\n  radius_m: 50\n  voxel_sise_m: 1.0\n"),
              AllOf(StartsWith("my.yaml:3:3: "), HasSubstr("unknown key 'map.voxel_sise_m'"),
                    HasSubstr("did you mean 'map.voxel_size_m'?")));
}

TEST(Config, KeyInTheWrongSectionIsRecognisedByItsLastPart) {
  EXPECT_THAT(LoadingError("segments: 3"), HasSubstr("did you mean 'window.segments'?"));
  EXPECT_THAT(LoadingError("windw: {segments: 3}"),
              HasSubstr("unknown key 'windw'; did you mean 'window'?"));
  EXPECT_THAT(LoadingError("expert: {marginalizatoin: {enabled: false}}"),
              HasSubstr("did you mean 'expert.marginalization'?"));
  EXPECT_THAT(LoadingError("map: {min_range_m: 3}"),
              HasSubstr("did you mean 'sensor.min_range_m'?"));
}

TEST(Config, UnknownKeyWithoutANearOneListsItsSection) {
  EXPECT_THAT(LoadingError("expert: {marginalization: {xyzzyplugh: 3}}"),
              AllOf(HasSubstr("expert.marginalization.enabled"),
                    HasSubstr("expert.marginalization.first_estimate_jacobians")));
  EXPECT_THAT(LoadingError("xyzzyplugh: 3"), HasSubstr("--show_config"));
}

TEST(Config, ASectionTakesNoValue) {
  EXPECT_THAT(LoadingError("window: 3"),
              HasSubstr("is a section, which holds the keys window.seg"));
  // Not the expert section of the same name.
  EXPECT_THAT(OverrideError("window=3"),
              HasSubstr("is a section, which holds the keys window.seg"));
}

TEST(Config, RepeatedKeyIsAnError) {
  EXPECT_THAT(LoadingError("window: {segments: 3,\n segments: 4}"),
              AllOf(StartsWith("my.yaml:2:"), HasSubstr("set twice")));
}

TEST(Config, RepeatedSectionAndSecondDocumentAreErrors) {
  EXPECT_THAT(LoadingError("window: {segments: 3}\nmap:\nwindow: {deskewing: predicted}"),
              AllOf(StartsWith("my.yaml:3:1"), HasSubstr("section 'window' appears twice")));
  EXPECT_THAT(LoadingError("expert: {map: {plane: {neighbors: 5}, plane: {}}}"),
              HasSubstr("section 'expert.map.plane' appears twice"));
  EXPECT_THAT(LoadingError("---\nwindow: {segments: 3}\n---\nwindow: {segments: 4}\n"),
              AllOf(StartsWith("my.yaml:3:"), HasSubstr("second YAML document")));
  EXPECT_EQ(Loaded("---\nwindow: {segments: 3}\n...\n").odometry.window.segments, 3);
}

TEST(Config, WhatIsNoFileOfTextIsRefusedAtOnce) {
  RunConfig config;
  for (const char* path : {"/dev/zero", "/dev/full", "/", "/nowhere.yaml"}) {
    EXPECT_THAT(ConfigErrorOf([&] { LoadConfigFile(path, &config); }), StartsWith(path));
  }
  const trajlo::testing::TempFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(ConfigErrorOf([&] { LoadConfigFile(pipe, &config); }),
              HasSubstr("not a regular file"));
}

TEST(Config, SectionWithAValueAndOptionWithASectionAreErrors) {
  EXPECT_THAT(LoadingError("\nwindow: 3"),
              AllOf(StartsWith("my.yaml:2:9"), HasSubstr("window.segments")));
  EXPECT_THAT(LoadingError("window: {segments: {a: 1}}"), HasSubstr("takes a single value"));
  EXPECT_THAT(LoadingError("window: {segments: }"), HasSubstr("has no value"));
  EXPECT_THAT(LoadingError("- 1\n- 2"), HasSubstr("expected sections"));
}

TEST(Config, BrokenYamlNamesTheLine) {
  EXPECT_THAT(LoadingError("map:\n  kind: [kd_tree\n"),
              AllOf(StartsWith("my.yaml:3:"), HasSubstr("not valid YAML")));
  // Of these yaml-cpp makes empty documents without end.
  for (const char* text : {", a", ",", ", window: {segments: 3}"}) {
    EXPECT_THAT(LoadingError(text), AllOf(StartsWith("my.yaml:1:1"), HasSubstr("not valid YAML")));
  }
}

TEST(Config, MissingFileAndFolderAreErrors) {
  RunConfig config;
  for (const char* path : {"/no/such/file.yaml", "/"}) {
    EXPECT_THAT(ConfigErrorOf([&] { LoadConfigFile(path, &config); }), StartsWith(path));
  }
}

TEST(Config, RelativePathsAreBelowTheFolderOfTheFileThatNamesThem) {
  const testing::TempFolder folder;
  const auto stamps_of = [&](const std::string& first, const std::string& second) {
    RunConfig config;
    config.input.stamps_file = "of_before.txt";
    for (const std::string& text : {first, second}) {
      std::ofstream(folder / "my.yaml") << text;
      LoadConfigFile(folder / "my.yaml", &config);
    }
    return config.input.stamps_file;
  };
  const std::string names_it = "input: {stamps_file: stamps.txt}";
  EXPECT_EQ(stamps_of(names_it, ""), folder / "stamps.txt");
  EXPECT_EQ(stamps_of("input: {stamps_file: /a/stamps.txt}", ""), "/a/stamps.txt");
  EXPECT_EQ(stamps_of("", ""), "of_before.txt");
  EXPECT_EQ(stamps_of(names_it, "input: {stamps_file: ''}"), "");
  EXPECT_EQ(Overridden("input.stamps_file=stamps.txt").input.stamps_file, "stamps.txt");
}

TEST(Config, FileWithAnErrorChangesNothing) {
  RunConfig config;
  EXPECT_THROW(LoadConfigText("window: {segments: 9}\nmap: {kind: x}", "my.yaml", &config),
               ConfigError);
  EXPECT_EQ(DumpConfig(config), DumpConfig(RunConfig()));
}

TEST(Overrides, SetSeveralKeysWithCommasInsideBrackets) {
  const RunConfig config = Overridden(
      "window.segments=2, solver.kind=gauss_newton,"
      "sensor.T_body_lidar=[{translation_m: [1, 2, 3]}],threads=1");
  EXPECT_EQ(config.odometry.window.segments, 2);
  EXPECT_EQ(config.odometry.solver.kind, SolverKind::kGaussNewton);
  ASSERT_EQ(config.odometry.segmenter.T_body_lidar.size(), 1u);
  EXPECT_EQ(config.odometry.segmenter.T_body_lidar[0].t, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(config.odometry.threads, 1);
}

TEST(Overrides, EmptyTextEmptyValueAndTextsWithCommas) {
  EXPECT_EQ(DumpConfig(Overridden("")), DumpConfig(RunConfig()));
  EXPECT_EQ(Overridden("input.time_field=").input.time_field.Of(0), "");
  EXPECT_EQ(Overridden("input.time_field='a,b'").input.time_field.Of(0), "a,b");
}

TEST(Overrides, ErrorsNameTheFlagAndTheKeyButNoLine) {
  EXPECT_THAT(
      OverrideError("window.segmets=2"),
      ::testing::Eq("--set: unknown key 'window.segmets'; did you mean 'window.segments'?"));
  EXPECT_THAT(OverrideError("window.segments"), HasSubstr("expected key=value"));
  EXPECT_THAT(OverrideError("window.segments=3,sensor.min_range_m=1,5"),
              HasSubstr("'sensor.min_range_m=1,5': numbers need a point"));
  EXPECT_THAT(OverrideError("window.segments=3,solver"), HasSubstr("expected key=value"));
  EXPECT_THAT(OverrideError("window.segments=two"),
              AllOf(StartsWith("--set: 'window.segments' must be a whole number from 1 to 100"),
                    HasSubstr("'two'")));
  EXPECT_THAT(OverrideError("window.segments=[2"), HasSubstr("not valid YAML"));
  EXPECT_THAT(OverrideError("window.segments=2,window.segments=3"), HasSubstr("set twice"));
}

TEST(Config, DumpLoadsBackToTheSameValues) {
  RunConfig config = Overridden(
      "window.segments=3,expert.map.kind=kd_tree,expert.registration.kernel=tukey,expert.solver."
      "ceres.trust_region="
      "dogleg,"
      "registration.sigma_m=0.1234567890123456,expert.solver.ceres.initial_trust_region_radius=1e7,"
      "input.time_field='a \"b\": #c',input.stamps_file=x/y.txt,input.point_time=none,"
      "input.time_unit=us,input.stamp_at=end,expert.marginalization.enabled=false");
  const Eigen::Quaterniond q = Eigen::Quaterniond(0.3, -0.2, 0.7, 0.1).normalized();
  config.odometry.segmenter.T_body_lidar = {{q, {0.1, 1.0 / 3.0, -1e-9}}, SE3()};
  const RunConfig back = Loaded(DumpConfig(config));
  EXPECT_EQ(DumpConfig(back), DumpConfig(config));
  EXPECT_EQ(back.input.time_field.Of(0), "a \"b\": #c");
  ASSERT_EQ(back.odometry.segmenter.T_body_lidar.size(), 2u);
  EXPECT_EQ(back.odometry.segmenter.T_body_lidar[0].q.coeffs(), q.coeffs());
  EXPECT_EQ(back.odometry.segmenter.T_body_lidar[0].t.y(), 1.0 / 3.0);
  EXPECT_EQ(back.odometry.registration.sigma_m, 0.1234567890123456);
}

TEST(Config, ARigLoadsBackToTheSameValues) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(0.3, -0.2, 0.7, 0.1).normalized();
  const RunConfig back =
      Loaded(RigYaml("two", {{q, {0.1, 1.0 / 3.0, -1e-9}}, SE3()}, {0, -0.0048}));
  ASSERT_EQ(back.odometry.segmenter.T_body_lidar.size(), 2u);
  EXPECT_EQ(back.odometry.segmenter.T_body_lidar[0].q.coeffs(), q.coeffs());
  EXPECT_EQ(back.odometry.segmenter.T_body_lidar[0].t, Eigen::Vector3d(0.1, 1.0 / 3.0, -1e-9));
  EXPECT_EQ(back.input.clock_offset_s.Of(1), -0.0048);
}

TEST(Config, ListedKeysCanBeSetToTheirDefaults) {
  for (const KeyInfo& key : ListKeys()) {
    EXPECT_EQ(OverrideError(key.key + "=" + key.default_value), "") << key.key;
    EXPECT_FALSE(key.doc.empty()) << key.key;
    EXPECT_FALSE(key.allowed.empty()) << key.key;
  }
}

TEST(Config, DefaultsPassTheChecks) { EXPECT_NO_THROW(CheckConfig(RunConfig())); }

TEST(Config, ValuesThatAProgramSetsAreCheckedAsWell) {
  RunConfig config;
  config.odometry.segmenter.interval_s = std::nan("");
  EXPECT_THAT(ConfigErrorOf([&] { CheckConfig(config); }),
              StartsWith("'segmenter.interval_s' must be a number from "));
}

TEST(Config, ContradictionsNameBothKeysAndTheirValues) {
  const auto problem = [](const std::string& settings) {
    return ConfigErrorOf([&] { CheckConfig(Overridden(settings)); });
  };
  EXPECT_THAT(problem("sensor.min_range_m=5,sensor.max_range_m=4"),
              AllOf(HasSubstr("sensor.min_range_m (5.0)"), HasSubstr("sensor.max_range_m (4.0)")));
  EXPECT_THAT(problem("expert.segmenter.map_voxel_m=1,expert.segmenter.registration_voxel_m=0.5"),
              HasSubstr("expert.segmenter.registration_voxel_m (0.5)"));
  for (const char* settings :
       {"segmenter.interval_s=0.5", "expert.segmenter.max_gap_s=0.02",
        "expert.map.min_point_spacing_m=0.9", "map.radius_m=2,map.voxel_size_m=3",
        "expert.map.plane.neighbors=3", "registration.sigma_m=0.31"}) {
    EXPECT_NE(problem(settings), "") << settings;
  }
  // As the user wrote it: multiplied out it would have rounding errors.
  EXPECT_THAT(problem("registration.sigma_m=0.31,expert.registration.kernel_m=0.1"),
              HasSubstr("must not exceed 3.0 x expert.registration.kernel_m (3.0 x 0.1): "));
  // Only a kernel that is fitted lies between the two.
  EXPECT_EQ(problem("registration.sigma_m=0.31,expert.registration.kernel_in_spreads=0"), "");
}

}  // namespace
}  // namespace trajlo
