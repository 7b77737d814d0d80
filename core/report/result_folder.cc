// SPDX-License-Identifier: MIT
#include "core/report/result_folder.h"

#include <system_error>

#include "core/io/errors.h"

namespace trajlo {

namespace fs = std::filesystem;

void ResultFolder::Check(bool overwrite) const {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status) && !fs::is_directory(status)) {
    throw OutputError(path_, "exists already and is not a folder; choose another --output");
  }
  if (overwrite) return;
  for (const fs::path& file :
       {summary(), trajectory(), map(), view(), windows(), flags(), covariance(), config()}) {
    if (fs::exists(fs::symlink_status(file, error))) {
      throw OutputError(path_, "holds an earlier result (" + file.filename().string() +
                                   "); choose another --output, or add --overwrite to replace it");
    }
  }
}

void ResultFolder::Prepare() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw OutputError(path_, "the folder cannot be created: " + error.message());
  // Links are left alone: somebody wants the file elsewhere, and writing follows them.
  for (const fs::path& file :
       {summary(), trajectory(), map(), view(), windows(), flags(), covariance(), config()}) {
    if (!fs::is_regular_file(fs::symlink_status(file, error))) continue;
    fs::remove(file, error);
    if (error) throw OutputError(file, "the earlier result cannot be removed: " + error.message());
  }
}

}  // namespace trajlo
