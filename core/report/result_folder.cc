// SPDX-License-Identifier: MIT
#include "core/report/result_folder.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "core/io/errors.h"

namespace trajlo {

namespace fs = std::filesystem;

namespace {

/// A summary of a run that was killed, or that still goes on.
bool IsUnfinished(const fs::path& file) {
  std::error_code error;
  if (file.filename() != "run.json" || !fs::is_regular_file(file, error)) return false;
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || !json.contains("exit") || !json["exit"].is_object()) return false;
  return json["exit"].value("reason", nlohmann::json()) == "running";
}

}  // namespace

void CheckResultFolder(const fs::path& folder, const std::vector<fs::path>& files, bool overwrite) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw OutputError(folder, "exists already and is not a folder; choose another --output");
  }
  if (overwrite) return;
  for (const fs::path& file : files) {
    if (fs::exists(fs::symlink_status(file, error))) {
      const char* what =
          IsUnfinished(file) ? "holds a result that did not finish (" : "holds an earlier result (";
      throw OutputError(folder, what + file.filename().string() +
                                    "); choose another --output, or add --overwrite to replace it");
    }
  }
}

void PrepareResultFolder(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "the folder cannot be created: " + error.message());
  for (const fs::path& file : files) {
    if (!fs::is_regular_file(fs::symlink_status(file, error))) continue;
    fs::remove(file, error);
    if (error) throw OutputError(file, "the earlier result cannot be removed: " + error.message());
  }
}

}  // namespace trajlo
