// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

namespace trajlo {

/// A block of bytes that is not zeroed when it is allocated: a scan is overwritten at once.
class FileBytes {
 public:
  FileBytes() = default;
  explicit FileBytes(std::size_t size) : data_(new char[size]), size_(size) {}
  // What is moved from is empty.
  FileBytes(FileBytes&& other) noexcept
      : data_(std::move(other.data_)), size_(std::exchange(other.size_, 0)) {}
  FileBytes& operator=(FileBytes&& other) noexcept {
    data_ = std::move(other.data_);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }

  char* data() { return data_.get(); }
  const char* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  std::string_view view() const { return {data_.get(), size_}; }
  /// Forgets the bytes from `size` on.
  void Shrink(std::size_t size) { size_ = size < size_ ? size : size_; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

/// Reads a whole file; throws InputError when it cannot be opened or read.
/// Plain read(2), not mmap: a mapped file that shrinks while it is read kills the process.
FileBytes ReadFileBytes(const std::filesystem::path& path);

}  // namespace trajlo
