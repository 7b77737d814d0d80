// SPDX-License-Identifier: MIT
#include "core/io/ros1/bag_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/io/errors.h"

namespace trajlo::ros1 {

BagFile::BagFile(const std::filesystem::path& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd_ < 0) {
    throw InputError(path, std::string("opening failed: ") + std::strerror(errno),
                     "Check that the file exists and that you may read it.");
  }
  struct stat info {};
  if (::fstat(fd_, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(fd_);
    throw InputError(path, "this is not a regular file", "Give a file, not a folder or a pipe.");
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
}

BagFile::~BagFile() { ::close(fd_); }

std::size_t BagFile::Read(std::uint64_t offset, char* bytes, std::size_t count) const {
  std::size_t filled = 0;
  while (filled < count) {
    const ssize_t got =
        ::pread(fd_, bytes + filled, count - filled, static_cast<off_t>(offset + filled));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    filled += static_cast<std::size_t>(got);
  }
  return filled;
}

}  // namespace trajlo::ros1
