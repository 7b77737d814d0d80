// SPDX-License-Identifier: MIT
#include "core/report/drawn_files.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <system_error>

#include "core/io/errors.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// Names that scripts/trajlo_report gives to the figures of a run and of an evaluation.
constexpr const char* kFigures[] = {
    "thumbnail",     "map",       "windows",          "trajectory",
    "error_on_path", "over_time", "error_components", "error_distribution",
    "kitti_lengths"};

nlohmann::json ReadEstimates(const fs::path& folder) {
  std::ifstream stream(folder / "evaluation.json");
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  const bool has_some = json.is_object() && json.contains("estimates");
  return has_some && json["estimates"].is_array() ? json["estimates"] : nlohmann::json();
}

/// Names that scripts/draw_comparison.py gives to its figures.
constexpr const char* kComparisonFigures[] = {"cost", "stages", "distances", "points", "free"};

void Remove(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(file, error))) return;
  fs::remove(file, error);
  if (error) throw OutputError(file, "the earlier result cannot be removed: " + error.message());
}

/// What somebody else put there stays, and with it the folder.
void RemoveIfEmpty(const fs::path& folder) {
  std::error_code error;
  const bool is_folder = fs::is_directory(fs::symlink_status(folder, error));
  if (is_folder && fs::is_empty(folder, error)) fs::remove(folder, error);
}

template <typename Names>
void AddFigures(const fs::path& folder, const Names& names, std::vector<fs::path>* files) {
  for (const char* name : names) {
    for (const char* kind : {".svg", ".pdf", ".png"}) {
      files->push_back(folder / "figures" / (std::string(name) + kind));
    }
  }
}

/// Files with the names that trajlo_run --inspect and draw_window.py give: "000431.json",
/// "000431_points.svg".
void AddGraphs(const fs::path& folder, std::vector<fs::path>* files) {
  static const std::regex name(
      "[0-9]{6,}(_(points|residuals|matrix))?\\.(json|ply|html|svg|pdf|png)");
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (std::regex_match(entry.path().filename().string(), name)) files->push_back(entry.path());
  }
}

}  // namespace

std::vector<fs::path> EvaluationFiles(const fs::path& folder) {
  std::vector<fs::path> files = {folder / "evaluation.json", folder / "evaluation.csv",
                                 folder / "evaluation.tex", folder / "report.html"};
  for (const nlohmann::json& estimate : ReadEstimates(folder)) {
    if (!estimate.is_object() || !estimate.contains("errors_csv")) continue;
    if (!estimate["errors_csv"].is_string()) continue;
    const fs::path name(estimate["errors_csv"].get<std::string>());
    // Only files of this folder, whatever the file says.
    if (name == name.filename() && name.string().rfind("errors_", 0) == 0) {
      files.push_back(folder / name);
    }
  }
  return files;
}

void RemoveWhatIsAboutResult(const fs::path& folder) {
  std::vector<fs::path> files;
  // Without its summary, files of these names are none of an evaluation.
  if (ReadEstimates(folder).is_array()) files = EvaluationFiles(folder);
  AddFigures(folder, kFigures, &files);
  files.push_back(folder / "run.html");
  AddGraphs(folder / "windows", &files);
  // The summary last: while a file is left, it says what the others are.
  for (auto file = files.rbegin(); file != files.rend(); ++file) Remove(*file);
  RemoveIfEmpty(folder / "figures");
  RemoveIfEmpty(folder / "windows");
}

void RemoveComparison(const fs::path& folder) {
  std::vector<fs::path> files;
  AddFigures(folder, kComparisonFigures, &files);
  for (const char* name : {"config.yaml", "lockstep.csv", "iterations.csv", "lockstep_summary.csv",
                           "free_summary.csv", "report.html"}) {
    files.push_back(folder / name);
  }
  std::vector<fs::path> folders = {folder / "figures"};
  std::error_code error;
  for (const auto& variant : fs::directory_iterator(folder / "free", error)) {
    files.push_back(variant.path() / "trajectory.tum");
    files.push_back(variant.path() / "windows.csv");
    folders.push_back(variant.path());
  }
  folders.push_back(folder / "free");
  // The summary last: while a file is left, it says what the others are.
  files.push_back(folder / "comparison.json");
  for (const fs::path& file : files) Remove(file);
  for (const fs::path& empty : folders) RemoveIfEmpty(empty);
}

}  // namespace trajlo
