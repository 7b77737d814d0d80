// SPDX-License-Identifier: MIT
#include "apps/config_names.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "apps/load_config.h"
#include "core/config/config_error.h"
#include "tests/support/temp_folder.h"

namespace trajlo::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A folder of configurations of its own, and an empty one to work in.
class ConfigNamesTest : public ::testing::Test {
 protected:
  ConfigNamesTest() : before_(fs::current_path()) {
    fs::create_directories(temp_ / "config/datasets");
    fs::create_directories(temp_ / "work");
    WriteFile(temp_ / "config/indoor.yaml",
              "# SPDX-License-Identifier: MIT\n# Rooms\n# and "
              "halls. And more.\nwindow: {segments: 5}\n");
    WriteFile(temp_ / "config/datasets/ouster.yaml", "# An Ouster\nwindow: {segments: 6}\n");
    setenv("TRAJLO_CONFIG_DIR", (temp_ / "config").c_str(), 1);
    fs::current_path(temp_ / "work");
  }
  ~ConfigNamesTest() override {
    unsetenv("TRAJLO_CONFIG_DIR");
    fs::current_path(before_);
  }

  static std::string Error(const std::string& word) {
    try {
      FindConfig(word);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  }

  TempFolder temp_;
  fs::path before_;
};

TEST_F(ConfigNamesTest, ListsThemWithTheirFirstSentence) {
  const std::vector<NamedConfig> configs = NamedConfigs();
  ASSERT_EQ(configs.size(), 2u);
  EXPECT_EQ(configs[0].name, "ouster");
  EXPECT_EQ(configs[0].sentence, "An Ouster");
  EXPECT_EQ(configs[1].name, "indoor");
  EXPECT_EQ(configs[1].sentence, "Rooms and halls.");
}

TEST_F(ConfigNamesTest, ANameIsFoundFromAnywhereAndLaterOnesWin) {
  EXPECT_EQ(FindConfig("ouster"), temp_ / "config/datasets/ouster.yaml");
  EXPECT_EQ(LoadConfig("indoor,ouster", "").odometry.window.segments, 6);
  EXPECT_EQ(LoadConfig("ouster,indoor", "").odometry.window.segments, 5);
}

TEST_F(ConfigNamesTest, APathStaysAPath) {
  WriteFile(temp_ / "work/ouster.yaml", "window: {segments: 7}\n");
  WriteFile(temp_ / "work/mine", "window: {segments: 8}\n");
  EXPECT_EQ(FindConfig("ouster.yaml"), "ouster.yaml");
  EXPECT_EQ(FindConfig("mine"), "mine");
  EXPECT_EQ(FindConfig("./mine"), "./mine");
}

TEST_F(ConfigNamesTest, MisspeltNamesAndMissingFilesAreExplained) {
  EXPECT_THAT(Error("oustr"), HasSubstr("did you mean --config=ouster?"));
  EXPECT_THAT(Error("config/datasets/ouster.yaml"), HasSubstr("did you mean --config=ouster?"));
  EXPECT_THAT(Error("xyzzyplugh"), HasSubstr("--list_configs"));
  setenv("TRAJLO_CONFIG_DIR", "/nowhere", 1);
  EXPECT_THAT(Error("ouster"), HasSubstr("TRAJLO_CONFIG_DIR: '/nowhere' is not a folder"));
  EXPECT_THAT(Error("mine.yaml"), HasSubstr("there is no file 'mine.yaml'"));
  unsetenv("TRAJLO_CONFIG_DIR");  // This test is in no bin/ folder with share/ beside it.
  EXPECT_THAT(Error("ouster"), HasSubstr("share/trajlo/config"));
  EXPECT_THAT(Error("ouster"), HasSubstr("give --config a path"));
  try {
    ConfigFolder("--variants");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("give --variants a path"));
  }
}

}  // namespace
}  // namespace trajlo::testing
