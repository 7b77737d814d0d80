// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

namespace trajlo {

/// Holds space on a disk as long as it lives, for what has to be written at the end although the
/// disk may be full by then. A process that is killed leaves nothing of it: the file has no name.
class DiskReserve {
 public:
  /// On the disk of `folder`. Throws OutputError if there is less space than that. Holds nothing
  /// where files may not be that large, or where the disk cannot do it.
  DiskReserve(const std::filesystem::path& folder, std::size_t bytes);
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;
  ~DiskReserve();

 private:
  int fd_ = -1;
};

}  // namespace trajlo
