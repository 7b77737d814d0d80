// SPDX-License-Identifier: MIT
#include "core/config/config_file.h"

#include <system_error>

#include "core/config/config_error.h"
#include "core/io/errors.h"
#include "core/io/file_bytes.h"

namespace trajlo {

std::string ReadConfigFile(const std::filesystem::path& path) {
  constexpr std::uintmax_t kLargest = 10'000'000;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kLargest) {
    throw ConfigError(path.string(), "this file has " + std::to_string(size / 1'000'000) +
                                         " MB, and is not a configuration");
  }
  try {
    return std::string(ReadFileBytes(path).view());
  } catch (const InputError& problem) {
    throw ConfigError(problem.what());
  }
}

}  // namespace trajlo
