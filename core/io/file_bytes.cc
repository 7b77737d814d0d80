// SPDX-License-Identifier: MIT
#include "core/io/file_bytes.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/io/errors.h"

namespace trajlo {
namespace {

struct Descriptor {
  int fd = -1;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

[[noreturn]] void Fail(const std::filesystem::path& path, const char* action) {
  throw InputError(path, std::string(action) + " failed: " + std::strerror(errno),
                   "Check that the file exists and that you may read it.");
}

}  // namespace

FileBytes ReadFileBytes(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe would wait for somebody to write to it.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  if (file.fd < 0) Fail(path, "opening");
  struct stat info {};
  if (::fstat(file.fd, &info) != 0) Fail(path, "stat");
  if (!S_ISREG(info.st_mode)) {
    throw InputError(path, "this is not a regular file", "Give a file, not a folder or a pipe.");
  }
  FileBytes bytes(static_cast<std::size_t>(info.st_size));
  std::size_t filled = 0;
  while (filled < bytes.size()) {
    const ssize_t got = ::read(file.fd, bytes.data() + filled, bytes.size() - filled);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) Fail(path, "reading");
    if (got == 0) break;  // The file became shorter while it was read.
    filled += static_cast<std::size_t>(got);
  }
  bytes.Shrink(filled);
  return bytes;
}

}  // namespace trajlo
