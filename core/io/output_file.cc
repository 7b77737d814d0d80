// SPDX-License-Identifier: MIT
#include "core/io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "core/io/errors.h"

namespace trajlo {
namespace {

bool IsDevice(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  return !error && std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path, IfExists if_exists) : path_(path) {
  // Without O_NONBLOCK, opening a pipe would wait for somebody to read from it.
  int flags = O_WRONLY | O_CREAT | O_CLOEXEC | O_TRUNC | O_NONBLOCK;
  if (if_exists == IfExists::kFail && !IsDevice(path)) flags |= O_EXCL;
  fd_ = ::open(path.c_str(), flags, 0666);
  if (fd_ < 0 && errno == EEXIST) {
    throw OutputError(path_,
                      "exists already; choose another name, or add --overwrite to replace it");
  }
  if (fd_ < 0 && errno == ENXIO) throw OutputError(path_, "is a pipe that nobody reads");
  if (fd_ < 0) Fail("creating");
  // Writing may wait.
  if (::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) & ~O_NONBLOCK) != 0) Fail("creating");
}

OutputFile::~OutputFile() {
  if (fd_ >= 0) ::close(fd_);
}

void OutputFile::Fail(const char* action) const {
  throw OutputError(path_, std::string(action) + " failed: " + std::strerror(errno));
}

void OutputFile::Write(std::string_view bytes) {
  if (fd_ < 0) throw OutputError(path_, "writing after Close");
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) Fail("writing");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::Sync() {
  // EINVAL and EROFS: a pipe or a device, which has nothing to wait for.
  if (fd_ >= 0 && ::fsync(fd_) != 0 && errno != EINVAL && errno != EROFS) Fail("syncing");
}

void OutputFile::Close() {
  if (fd_ < 0) return;
  const int closed = ::close(std::exchange(fd_, -1));
  if (closed != 0 && errno != EINTR) Fail("closing");
}

}  // namespace trajlo
