// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "core/io/output_file.h"

namespace trajlo {

/// A file that appears under its name only when it is complete: it is written beside, as
/// `<name>.part`, and renamed by Commit(). Without Commit() nothing remains.
/// Devices such as /dev/full are written directly. Members throw OutputError.
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path, IfExists if_exists = IfExists::kFail);
  ~AtomicFile();

  void Write(std::string_view bytes) { file_->Write(bytes); }
  void Commit();
  /// Where the bytes are until then, for a library that writes a file by itself.
  const std::filesystem::path& part_path() const { return part_path_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path part_path_;
  IfExists if_exists_;
  bool committed_ = false;
  std::unique_ptr<OutputFile> file_;
};

/// Writes a whole text file at once.
void WriteTextFile(const std::filesystem::path& path, std::string_view text,
                   IfExists if_exists = IfExists::kFail);

}  // namespace trajlo
