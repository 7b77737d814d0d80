// SPDX-License-Identifier: MIT
#include "core/io/ros2/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/io/errors.h"

namespace trajlo {

InputFile::InputFile(const std::filesystem::path& path)
    : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat info {};
  if (fd_ < 0 || ::fstat(fd_, &info) != 0) {
    const std::string reason = std::strerror(errno);
    if (fd_ >= 0) ::close(fd_);
    throw InputError(path, "opening failed: " + reason,
                     "Check that the file exists and that you may read it.");
  }
  if (!S_ISREG(info.st_mode)) {
    ::close(fd_);
    throw InputError(path, "this is not a regular file", "Give a file, not a folder or a pipe.");
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
}

InputFile::~InputFile() { ::close(fd_); }

FileBytes InputFile::ReadAt(std::uint64_t offset, std::size_t size) const {
  if (offset >= size_) return {};
  FileBytes bytes(static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - offset)));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::pread(fd_, bytes.data() + filled, bytes.size() - filled,
                                static_cast<off_t>(offset + filled));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes.Shrink(filled);
  return bytes;
}

}  // namespace trajlo
