// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trajlo {

/// A configuration that comes with trajlo.
struct NamedConfig {
  std::string name;  ///< "ouster"
  std::filesystem::path file;
  std::string sentence;  ///< What it is for: the first of its comment.
};

/// The folder with the configurations: TRAJLO_CONFIG_DIR, else share/trajlo/config beside the
/// folder of this program, where both the build and the installation have it. Throws ConfigError;
/// `flag` is the one that takes a path in place of what is missing.
std::filesystem::path ConfigFolder(const std::string& flag = "--config");

/// Those of the sensors and datasets, then the general ones, by name. Throws ConfigError.
std::vector<NamedConfig> NamedConfigs();

/// The file that a word of --config means: a name, or a path if it holds a slash or ends in .yaml.
/// A file of the working folder may stand without either, if no configuration has its name.
/// Throws ConfigError on a name that is none, with the nearest.
std::filesystem::path FindConfig(const std::string& word);

}  // namespace trajlo
