// SPDX-License-Identifier: MIT
#include "core/io/random_access_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

#include "core/io/errors.h"

namespace trajlo {

// O_NONBLOCK: opening a pipe would otherwise wait for somebody to write to it.
RandomAccessFile::RandomAccessFile(const std::filesystem::path& path)
    : path_(path), fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
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

RandomAccessFile::~RandomAccessFile() { ::close(fd_); }

std::size_t RandomAccessFile::Read(std::uint64_t offset, char* bytes, std::size_t count,
                                   int* error) const {
  std::size_t filled = 0;
  while (filled < count) {
    const ssize_t got =
        ::pread(fd_, bytes + filled, count - filled, static_cast<off_t>(offset + filled));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 && error != nullptr) *error = errno;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

FileBytes RandomAccessFile::Read(std::uint64_t offset, std::size_t count) const {
  if (offset >= size_) return {};
  FileBytes bytes(static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - offset)));
  bytes.Shrink(Read(offset, bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace trajlo
