// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string_view>

namespace trajlo {

/// What to do when a result file exists already. Never replaced without being told so.
enum class IfExists { kFail, kReplace };

/// A file being written with write(2), so that a failure is seen at the call that causes it.
/// Every member throws OutputError: no permission, disk full, ...
class OutputFile {
 public:
  /// Creates the file. Devices such as /dev/stdout are opened whatever `if_exists` says.
  OutputFile(const std::filesystem::path& path, IfExists if_exists);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Closes silently: call Close() to learn of errors.
  ~OutputFile();

  void Write(std::string_view bytes);
  /// Waits until the bytes are on the disk.
  void Sync();
  void Close();
  const std::filesystem::path& path() const { return path_; }

 private:
  [[noreturn]] void Fail(const char* action) const;

  std::filesystem::path path_;
  int fd_ = -1;
};

}  // namespace trajlo
