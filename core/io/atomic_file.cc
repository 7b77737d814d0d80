// SPDX-License-Identifier: MIT
#include "core/io/atomic_file.h"

#include <system_error>

#include "core/io/errors.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// Where the bytes go first; the path itself if that is a device, which cannot be renamed onto.
fs::path PartPath(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return path;
  return path.string() + ".part";
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& path, IfExists if_exists)
    : path_(path), part_path_(PartPath(path)), if_exists_(if_exists) {
  std::error_code error;
  if (if_exists_ == IfExists::kFail && part_path_ != path_ && fs::exists(path_, error)) {
    throw OutputError(path_,
                      "exists already; choose another name, or add --overwrite to replace it");
  }
  // A left-over of an interrupted run may be replaced.
  file_ = std::make_unique<OutputFile>(part_path_, IfExists::kReplace);
}

AtomicFile::~AtomicFile() {
  if (committed_ || part_path_ == path_) return;
  file_.reset();
  std::error_code ignored;
  fs::remove(part_path_, ignored);
}

void AtomicFile::Commit() {
  // The bytes reach the disk before the name: a crash must not leave a complete name on a short
  // file.
  file_->Sync();
  file_->Close();
  if (part_path_ != path_) {
    std::error_code error;
    if (if_exists_ == IfExists::kFail) {
      // A hard link, unlike a rename, fails if somebody else has made the file in the meantime.
      fs::create_hard_link(part_path_, path_, error);
      if (error == std::errc::file_exists) {
        throw OutputError(path_, "was made by somebody else in the meantime and is not replaced");
      }
      if (!error) {
        fs::remove(part_path_, error);
        committed_ = true;
        return;
      }
    }
    fs::rename(part_path_, path_, error);
    if (error) throw OutputError(path_, "renaming failed: " + error.message());
  }
  committed_ = true;
}

void WriteTextFile(const fs::path& path, std::string_view text, IfExists if_exists) {
  AtomicFile file(path, if_exists);
  file.Write(text);
  file.Commit();
}

}  // namespace trajlo
