// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/io/file_bytes.h"

namespace trajlo {

/// A file of any size that is read piece by piece with pread(2). It stays readable when its name is
/// removed.
class InputFile {
 public:
  /// Throws InputError when it cannot be opened or is no regular file.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// When it was opened.
  std::uint64_t size() const { return size_; }
  /// At most `size` bytes: fewer at the end of the file and behind a reading error.
  FileBytes ReadAt(std::uint64_t offset, std::size_t size) const;

 private:
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace trajlo
