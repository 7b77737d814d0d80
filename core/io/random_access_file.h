// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "core/io/file_bytes.h"

namespace trajlo {

/// A file that is read at any place, also beyond 4 GiB; it stays readable when its name is removed.
/// Plain pread(2), not mmap: a mapped file that shrinks while it is read kills the process.
class RandomAccessFile {
 public:
  /// Throws InputError when the file cannot be opened or is not a regular file.
  explicit RandomAccessFile(const std::filesystem::path& path);
  RandomAccessFile(const RandomAccessFile&) = delete;
  RandomAccessFile& operator=(const RandomAccessFile&) = delete;
  ~RandomAccessFile();

  const std::filesystem::path& path() const { return path_; }
  /// As it was when the file was opened.
  std::uint64_t size() const { return size_; }

  /// Reads up to `count` bytes; fewer at the end of the file or where the disk fails, which sets
  /// `error` to the number of the system's error.
  std::size_t Read(std::uint64_t offset, char* bytes, std::size_t count,
                   int* error = nullptr) const;
  /// The same into memory of its own, no larger than what lies behind `offset`.
  FileBytes Read(std::uint64_t offset, std::size_t count) const;

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace trajlo
