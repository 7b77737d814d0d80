// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/io/file_bytes.h"

namespace trajlo {

enum class Codec { kZstd, kLz4Frame };

/// What came out of compressed bytes.
struct Unpacked {
  FileBytes bytes;
  /// Empty, or why not everything came out.
  std::string problem;
};

/// Unpacks up to `size` bytes. Memory grows with what really comes out, whatever `size` says; of
/// bytes that are cut or broken comes out what stands before that place.
Unpacked Unpack(Codec codec, std::string_view packed, std::uint64_t size);

/// rosbag2 can compress every message by itself. A message in CDR never begins like a zstd frame:
/// those that do are unpacked in place. False if that fails; `message` is then as it was.
bool UnpackMessage(FileBytes* message);

/// A file that is removed with its handle.
class TempFile {
 public:
  explicit TempFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TempFile();
  TempFile(TempFile&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  TempFile& operator=(TempFile&&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Unpacks a file compressed with zstd into the folder for temporary files; `problem` as in
/// Unpacked. Throws InputError if it cannot be read, is no such file, or there is no space.
TempFile UnpackFile(const std::filesystem::path& path, std::string* problem);

}  // namespace trajlo
