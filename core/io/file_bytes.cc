// SPDX-License-Identifier: MIT
#include "core/io/file_bytes.h"

#include <cstring>
#include <string>

#include "core/io/errors.h"
#include "core/io/random_access_file.h"

namespace trajlo {

FileBytes ReadFileBytes(const std::filesystem::path& path) {
  const RandomAccessFile file(path);
  FileBytes bytes(static_cast<std::size_t>(file.size()));
  int error = 0;
  // Fewer bytes without an error: the file became shorter while it was read.
  bytes.Shrink(file.Read(0, bytes.data(), bytes.size(), &error));
  if (error != 0) {
    throw InputError(path, std::string("reading failed: ") + std::strerror(error),
                     "Check that the file exists and that you may read it.");
  }
  return bytes;
}

}  // namespace trajlo
