// SPDX-License-Identifier: MIT
#pragma once

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/evaluation/evaluation.h"

namespace trajlo::testing {

/// The folder of trajectories with the numbers that established tools give for them; the
/// environment variable TRAJLO_DATA goes first.
inline std::filesystem::path EvaluationData() {
  const char* set = std::getenv("TRAJLO_DATA");
  return std::filesystem::path(set != nullptr ? set : TRAJLO_DATA_DIR) / "evaluation";
}

/// A test on these data; it skips where they are absent.
class OracleTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(EvaluationData() / "expected")) {
      GTEST_SKIP() << "no reference data in " << EvaluationData();
    }
  }
};

using CsvRow = std::map<std::string, std::string>;

/// Rows of a csv without quotes, by the names of the header.
inline std::vector<CsvRow> ReadCsv(const std::filesystem::path& path) {
  std::ifstream file(path);
  const auto split = [](const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == ',') {
        fields.emplace_back();
      } else {
        fields.back() += c;
      }
    }
    return fields;
  };
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> names = split(line);
  std::vector<CsvRow> rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> fields = split(line);
    CsvRow row;
    for (std::size_t i = 0; i < names.size() && i < fields.size(); ++i) row[names[i]] = fields[i];
    rows.push_back(row);
  }
  return rows;
}

inline nlohmann::json ReadJson(const std::string& name) {
  std::ifstream file(EvaluationData() / "expected" / name);
  return nlohmann::json::parse(file);
}

/// A trajectory of the reference data, by default as evo uses it; read once for all tests of a
/// program.
inline const TimedPoses& Poses(const std::string& name,
                               RepeatedStamps repeated_stamps = RepeatedStamps::kAll) {
  static std::map<std::pair<std::string, RepeatedStamps>, TimedPoses> cache;
  const auto found = cache.find({name, repeated_stamps});
  if (found != cache.end()) return found->second;
  std::vector<std::string> warnings;
  const TrajectoryFile file =
      ReadTrajectory(EvaluationData() / name, TrajectoryFormat::kAuto, &warnings);
  return cache[{name, repeated_stamps}] = OrderByTime(file, name, repeated_stamps, &warnings);
}

inline AlignmentKind AlignmentOf(const std::string& name) {
  if (name == "se3") return AlignmentKind::kSe3;
  if (name == "sim3") return AlignmentKind::kSim3;
  if (name == "scale") return AlignmentKind::kScale;
  if (name == "origin") return AlignmentKind::kOrigin;
  EXPECT_EQ(name, "none");
  return AlignmentKind::kNone;
}

/// evo's association and no relative errors.
inline EvaluationOptions EvoOptions(AlignmentKind alignment) {
  EvaluationOptions options;
  options.association.rule = AssociationRule::kNearest;
  options.alignment.kind = alignment;
  return options;
}

/// The statistics of an oracle, whose names are those of the struct.
template <typename Get>
void ExpectStatistics(const ErrorStatistics& s, Get&& expected, double relative, double absolute) {
  const auto compare = [&](const char* name, double value) {
    const double e = expected(name);
    EXPECT_NEAR(value, e, std::max(absolute, relative * std::abs(e))) << name;
  };
  compare("rmse", s.rmse);
  compare("mean", s.mean);
  compare("median", s.median);
  compare("std", s.std);
  compare("min", s.min);
  compare("max", s.max);
}

}  // namespace trajlo::testing
