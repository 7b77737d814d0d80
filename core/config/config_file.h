// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace trajlo {

/// The text of a YAML file. Throws ConfigError on what is no regular file, cannot be read, or is
/// far too large to be written by people.
std::string ReadConfigFile(const std::filesystem::path& path);

}  // namespace trajlo
