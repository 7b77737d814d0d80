// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/evaluation/evaluation.h"

namespace trajlo {

/// What the command line of trajlo_evaluate asks for.
struct EvaluateRequest {
  std::vector<std::filesystem::path> estimates;
  std::vector<std::string> names;  ///< One for each estimate, all different.
  std::filesystem::path truth;
  TrajectoryFormat estimate_format = TrajectoryFormat::kAuto;
  TrajectoryFormat truth_format = TrajectoryFormat::kAuto;
  /// Stamps for the lines of files without stamps; may be empty.
  std::filesystem::path times;
  RepeatedStamps repeated_stamps = RepeatedStamps::kFirst;
  EvaluationOptions options;
  std::filesystem::path output;  ///< May be empty: nothing is written.
  bool overwrite = false;
  bool draw = true;    ///< Figures and a page are made of the output.
  bool quiet = false;  ///< Only warnings and errors are printed.
  std::vector<std::string> command_line;
};

/// What is said about a trajectory in reports.
struct TrajectorySummary {
  std::string file;
  std::string format;
  std::size_t poses = 0;
  bool has_stamps = false;
  std::int64_t begin_ns = 0, end_ns = 0;
  double path_length_m = 0.0;
};

struct EstimateReport {
  std::string name;
  TrajectorySummary trajectory;
  std::string errors_csv;  ///< Name of the file in the output folder.
  /// Nothing if it could not be compared with the truth; `failure` says why.
  std::optional<Evaluation> evaluation;
  std::string failure;

  /// The x of the tables.
  bool Diverged() const { return !evaluation || !evaluation->divergence_reason.empty(); }
  const std::string& DivergenceReason() const {
    return evaluation ? evaluation->divergence_reason : failure;
  }
};

struct EvaluationReport {
  TrajectorySummary truth;
  bool truth_has_orientation = true;
  std::vector<EstimateReport> estimates;
  std::vector<std::string> warnings;
};

}  // namespace trajlo
