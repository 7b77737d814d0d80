// SPDX-License-Identifier: MIT
#include "apps/config_names.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "core/config/config_error.h"
#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;

/// The first sentence of the comment that a file begins with.
std::string FirstSentence(const fs::path& file) {
  std::ifstream stream(file);
  std::string text;
  for (std::string line; std::getline(stream, line) && line.compare(0, 2, "# ") == 0;) {
    if (line.find("SPDX") != std::string::npos) continue;
    text += (text.empty() ? "" : " ") + line.substr(2);
  }
  const std::size_t stop = text.find(". ");
  return stop == std::string::npos ? text : text.substr(0, stop + 1);
}

bool IsYaml(const fs::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

void AddConfigs(const fs::path& folder, std::vector<NamedConfig>* configs) {
  std::vector<NamedConfig> found;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!IsYaml(it->path()) || !it->is_regular_file(error)) continue;
    found.push_back({it->path().stem().string(), it->path(), FirstSentence(it->path())});
  }
  std::sort(found.begin(), found.end(),
            [](const NamedConfig& a, const NamedConfig& b) { return a.name < b.name; });
  configs->insert(configs->end(), found.begin(), found.end());
}

/// For a suggestion only.
std::vector<NamedConfig> NamedConfigsOrNone() {
  try {
    return NamedConfigs();
  } catch (const ConfigError&) {
    return {};
  }
}

}  // namespace

fs::path ConfigFolder(const std::string& flag) {
  std::error_code error;
  const char* set = std::getenv("TRAJLO_CONFIG_DIR");
  if (set != nullptr && *set != '\0') {
    if (fs::is_directory(set, error)) return set;
    throw ConfigError("TRAJLO_CONFIG_DIR", std::string("'") + set + "' is not a folder");
  }
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path folder = program.parent_path().parent_path() / "share" / "trajlo" / "config";
  if (fs::is_directory(folder, error)) return folder;
  throw ConfigError("the configurations are not in " + folder.string() +
                    "; set TRAJLO_CONFIG_DIR to trajlo's config folder, or give " + flag +
                    " a path");
}

std::vector<NamedConfig> NamedConfigs() {
  const fs::path folder = ConfigFolder();
  std::vector<NamedConfig> configs;
  AddConfigs(folder / "datasets", &configs);
  AddConfigs(folder, &configs);
  return configs;
}

fs::path FindConfig(const std::string& word) {
  std::error_code error;
  const bool is_path = word.find('/') != std::string::npos || IsYaml(word);
  if (is_path && (fs::exists(word, error) || error)) return word;  // Reading says what is wrong.
  const std::string name = is_path ? fs::path(word).stem().string() : word;
  std::vector<std::string> names;
  for (const NamedConfig& config : is_path ? NamedConfigsOrNone() : NamedConfigs()) {
    if (config.name == name && !is_path) return config.file;
    names.push_back(config.name);
  }
  if (!is_path && fs::exists(word, error)) return word;
  const std::string text = "there is no " + std::string(is_path ? "file" : "configuration") + " '" +
                           word + "'" + Suggestion(NearestKey(name, names), "--config=", "");
  throw ConfigError("--config", text + "\n  trajlo_run --list_configs shows those that there are.");
}

}  // namespace trajlo
