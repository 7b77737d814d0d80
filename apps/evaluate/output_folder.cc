// SPDX-License-Identifier: MIT
#include "apps/evaluate/output_folder.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/evaluate/evaluation_csv.h"
#include "apps/evaluate/evaluation_json.h"
#include "apps/evaluate/evaluation_tex.h"
#include "core/io/atomic_file.h"
#include "core/report/result_folder.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> FilesOf(const fs::path& folder) {
  return {folder / "evaluation.json", folder / "evaluation.csv", folder / "evaluation.tex",
          folder / "report.html"};
}

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

}  // namespace

void CheckEvaluationFolder(const fs::path& folder, bool overwrite) {
  CheckResultFolder(folder, FilesOf(folder), overwrite);
}

void WriteEvaluation(const EvaluateRequest& request, const EvaluationReport& report) {
  const fs::path& folder = request.output;
  const IfExists if_exists = request.overwrite ? IfExists::kReplace : IfExists::kFail;
  std::vector<fs::path> files = FilesOf(folder);
  const std::vector<fs::path> errors = EarlierErrors(folder);
  files.insert(files.end(), errors.begin(), errors.end());
  PrepareResultFolder(folder, files);
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
