// SPDX-License-Identifier: MIT
#include "core/report/result_folder.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <system_error>

#include "core/io/errors.h"
#include "core/report/drawn_files.h"

namespace trajlo {

namespace fs = std::filesystem;

namespace {

/// A summary of a run that was killed or is still running.
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
  const auto status_of = [&](const fs::path& file) { return fs::symlink_status(file, error); };
  const auto exists = [&](const fs::path& file) { return fs::exists(status_of(file)); };
  const auto is_file = [&](const fs::path& file) { return fs::is_regular_file(status_of(file)); };
  const auto found = std::find_if(files.begin(), files.end(), exists);
  if (found == files.end()) return;
  // Of a recording, or of somebody's own: it is not ours to replace.
  const auto other = std::find_if(files.begin(), files.end(), is_file);
  if (other != files.end() && !exists(files.front())) {
    throw OutputError(folder, "holds " + other->filename().string() + ", but no " +
                                  files.front().filename().string() +
                                  ", so it is not an earlier result; choose another --output, or "
                                  "remove the file if nobody needs it");
  }
  if (overwrite) return;
  const char* what =
      IsUnfinished(*found) ? "holds a result that did not finish (" : "holds an earlier result (";
  throw OutputError(folder, what + found->filename().string() +
                                "); choose another --output, or add --overwrite to replace it");
}

void PrepareResultFolder(const fs::path& folder, const std::vector<fs::path>& files) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "the folder cannot be created: " + error.message());
  // The summary last: while a file is left, it says what the folder is.
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    if (!fs::is_regular_file(fs::symlink_status(*file, error))) continue;
    fs::remove(*file, error);
    if (error) throw OutputError(*file, "the earlier result cannot be removed: " + error.message());
  }
}

void ResultFolder::Prepare() const {
  std::error_code error;
  if (fs::is_regular_file(fs::symlink_status(summary(), error))) RemoveWhatIsAboutResult(path_);
  PrepareResultFolder(path_, Files());
}

}  // namespace trajlo
