// SPDX-License-Identifier: MIT
// No option without a key, no key without a place in config/default.yaml.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <type_traits>
#include <utility>

#include "core/config/config.h"

namespace trajlo {
namespace {

/// Stands for a value of any type in an aggregate initialisation that is never evaluated.
struct AnyValue {
  template <typename T>
  operator T() const {
    return {};
  }
};

template <typename T, typename Indices, typename = void>
struct TakesValues : std::false_type {};
template <std::size_t>
using AnyValueAt = AnyValue;
template <typename T, std::size_t... I>
struct TakesValues<T, std::index_sequence<I...>, std::void_t<decltype(T{AnyValueAt<I>{}...})>>
    : std::true_type {};

/// How many fields an aggregate has: the most values that it can be initialised with.
template <typename T, std::size_t N = 0>
constexpr std::size_t FieldCount() {
  if constexpr (TakesValues<T, std::make_index_sequence<N + 1>>::value) {
    return FieldCount<T, N + 1>();
  } else {
    return N;
  }
}

/// Keys directly in a section, not in a section below it.
std::size_t KeysIn(const std::string& section) {
  std::size_t count = 0;
  for (const KeyInfo& info : ListKeys()) {
    const std::string expert = "expert.";
    const std::string key =
        info.key.rfind(expert, 0) == 0 ? info.key.substr(expert.size()) : info.key;
    const std::size_t dot = key.rfind('.');
    count += key.substr(0, dot == std::string::npos ? 0 : dot) == section ? 1 : 0;
  }
  return count;
}

std::string ReadFile(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ConfigCompleteness, EveryFieldOfTheOptionsHasAKey) {
  EXPECT_EQ(FieldCount<SegmenterOptions>(), KeysIn("segmenter") + KeysIn("sensor"));
  // `finest` and `plane`.
  EXPECT_EQ(FieldCount<MapOptions>() + FieldCount<MapPyramidOptions>(), KeysIn("map") + 2);
  EXPECT_EQ(FieldCount<PlaneFitOptions>(), KeysIn("map.plane"));
  EXPECT_EQ(FieldCount<RegistrationOptions>(), KeysIn("registration"));
  EXPECT_EQ(FieldCount<MotionPriorOptions>(), KeysIn("motion_prior"));
  // The step tolerance has two.
  EXPECT_EQ(FieldCount<SolverOptions>() + 1, KeysIn("solver"));
  EXPECT_EQ(FieldCount<CeresFormOptions>(), KeysIn("solver.ceres"));
  EXPECT_EQ(FieldCount<MarginalizationOptions>(), KeysIn("marginalization"));
  EXPECT_EQ(FieldCount<WindowOptions>(), KeysIn("window"));
  EXPECT_EQ(FieldCount<InitializationOptions>(), KeysIn("initialization"));
  EXPECT_EQ(FieldCount<OdometryOptions>(), 8 + KeysIn(""));  // Eight sections.
  EXPECT_EQ(FieldCount<RecordingOptions>(), KeysIn("input"));
}

TEST(ConfigCompleteness, KeysAreUnique) {
  std::set<std::string> keys;
  for (const KeyInfo& info : ListKeys()) EXPECT_TRUE(keys.insert(info.key).second) << info.key;
}

/// The first line in which two texts differ; empty if they are equal.
std::string FirstDifference(const std::string& a, const std::string& b) {
  std::istringstream lines_a(a), lines_b(b);
  std::string line_a, line_b;
  while (std::getline(lines_a, line_a)) {
    if (!std::getline(lines_b, line_b) || line_a != line_b) return line_a + " | " + line_b;
  }
  return std::getline(lines_b, line_b) ? " | " + line_b : "";
}

TEST(ConfigCompleteness, DefaultAndExpertYamlAreUpToDate) {
  const std::filesystem::path folder = TRAJLO_CONFIG_DIR;
  EXPECT_EQ(FirstDifference(ReadFile(folder / "default.yaml"),
                            DumpConfig(RunConfig(), DumpedOptions::kForUsers)),
            "")
      << "regenerate it: trajlo_run --show_config > config/default.yaml";
  EXPECT_EQ(FirstDifference(ReadFile(folder / "expert.yaml"),
                            DumpConfig(RunConfig(), DumpedOptions::kForExperts)),
            "")
      << "regenerate it: trajlo_run --show_expert_config > config/expert.yaml";
}

TEST(ConfigCompleteness, AUserMeetsFewOptions) {
  int users = 0, experts = 0;
  for (const KeyInfo& info : ListKeys()) ++(info.key.rfind("expert.", 0) == 0 ? experts : users);
  EXPECT_LE(users, 25);
  EXPECT_LE(experts, 38);
}

TEST(ConfigCompleteness, EveryShippedConfigLoadsAndPassesTheChecks) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TRAJLO_CONFIG_DIR)) {
    const std::string folder = entry.path().parent_path().filename();
    if (entry.path().extension() != ".yaml" || (folder != "config" && folder != "datasets")) {
      continue;
    }
    RunConfig config;
    EXPECT_NO_THROW({
      LoadConfigFile(entry.path(), &config);
      CheckConfig(config);
    }) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 7);
}

}  // namespace
}  // namespace trajlo
