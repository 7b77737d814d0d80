// SPDX-License-Identifier: MIT
#include "apps/evaluate/output_folder.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "apps/evaluate/evaluation_csv.h"
#include "apps/evaluate/evaluation_json.h"
#include "apps/evaluate/evaluation_tex.h"
#include "core/io/atomic_file.h"
#include "core/io/errors.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFiles[] = {"evaluation.json", "evaluation.csv", "evaluation.tex",
                                  "report.html"};

/// The errors_<name>.csv that an earlier evaluation says it wrote.
std::vector<fs::path> EarlierErrors(const fs::path& folder) {
  std::vector<fs::path> files;
  std::ifstream stream(folder / "evaluation.json");
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("estimates") || !json["estimates"].is_array()) return {};
  for (const nlohmann::json& estimate : json["estimates"]) {
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

void Prepare(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "the folder cannot be created: " + error.message());
  std::vector<fs::path> earlier = EarlierErrors(folder);
  for (const char* name : kFiles) earlier.push_back(folder / name);
  for (const fs::path& file : earlier) {
    if (!fs::is_regular_file(fs::symlink_status(file, error))) continue;
    fs::remove(file, error);
    if (error) throw OutputError(file, "the earlier result cannot be removed: " + error.message());
  }
}

}  // namespace

void CheckEvaluationFolder(const fs::path& folder, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw OutputError(folder, "exists already and is not a folder; choose another --output");
  }
  if (overwrite) return;
  for (const char* name : kFiles) {
    if (fs::exists(fs::symlink_status(folder / name, error))) {
      throw OutputError(folder, std::string("holds an earlier result (") + name +
                                    "); choose another --output, or add --overwrite to replace it");
    }
  }
}

void WriteEvaluation(const EvaluateRequest& request, const EvaluationReport& report) {
  const fs::path& folder = request.output;
  const IfExists if_exists = request.overwrite ? IfExists::kReplace : IfExists::kFail;
  Prepare(folder);
  for (const EstimateReport& estimate : report.estimates) {
    if (!estimate.evaluation) continue;
    WriteTextFile(folder / estimate.errors_csv,
                  ErrorsCsv(*estimate.evaluation, report.truth.has_stamps), if_exists);
  }
  WriteTextFile(folder / "evaluation.csv", EvaluationCsv(request, report), if_exists);
  WriteTextFile(folder / "evaluation.tex", EvaluationTex(request, report), if_exists);
  WriteTextFile(folder / "evaluation.json", EvaluationJson(request, report), if_exists);
}

}  // namespace trajlo
