// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace trajlo::ros1 {

/// A file that is read at any place, also beyond 4 GiB. Plain pread(2), not mmap: a mapped file
/// that shrinks while it is read kills the process.
class BagFile {
 public:
  /// Throws InputError when the file cannot be opened or is not a regular file.
  explicit BagFile(const std::filesystem::path& path);
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;
  ~BagFile();

  const std::filesystem::path& path() const { return path_; }
  /// As it was when the file was opened.
  std::uint64_t size() const { return size_; }
  /// Reads up to `count` bytes; fewer at the end of the file or where the disk fails.
  std::size_t Read(std::uint64_t offset, char* bytes, std::size_t count) const;

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace trajlo::ros1
