// SPDX-License-Identifier: MIT
#include "core/io/disk_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "core/io/errors.h"

namespace trajlo {

DiskReserve::DiskReserve(const std::filesystem::path& folder, std::size_t bytes) {
  std::string name = folder / ".reserve-XXXXXX";
  fd_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (fd_ < 0) return;  // Whoever writes next says why.
  ::unlink(name.c_str());
  int error = EINTR;
  while (error == EINTR) error = ::posix_fallocate(fd_, 0, static_cast<off_t>(bytes));
  if (error != ENOSPC && error != EDQUOT) return;
  ::close(fd_);
  throw OutputError(folder, "there is hardly any space left on this disk (" +
                                std::string(std::strerror(error)) + ")");
}

DiskReserve::~DiskReserve() {
  if (fd_ >= 0) ::close(fd_);
}

}  // namespace trajlo
