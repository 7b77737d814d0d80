// SPDX-License-Identifier: MIT
#include "apps/load_config.h"

#include <gflags/gflags.h>

#include <filesystem>

#include "apps/config_names.h"
#include "apps/read_flags.h"
#include "apps/split_at_commas.h"
#include "apps/usage_error.h"

namespace trajlo {
namespace {

/// In quotes for YAML, so that no comma within begins another option.
std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

/// What the flag says, as --set takes it.
std::string ValueOf(const gflags::CommandLineFlagInfo& flag) {
  if (flag.type != "string") return flag.current_value;
  if (!IsList(flag.name)) return Quoted(flag.current_value);
  std::string list;
  for (const std::string& part : SplitAtCommas(flag.current_value)) {
    list += (list.empty() ? "" : ", ") + Quoted(part);
  }
  return "[" + list + "]";
}

/// As the folder may be another one where config.yaml of the result is used.
void MakePathsAbsolute(RunConfig* config) {
  std::filesystem::path& file = config->input.stamps_file;
  if (!file.empty()) file = std::filesystem::absolute(file);
}

}  // namespace

RunConfig LoadConfig(const std::string& files, const std::string& settings,
                     const std::vector<Shorthand>& shorthands) {
  RunConfig base;
  for (const std::string& file : SplitAtCommas(files)) LoadConfigFile(FindConfig(file), &base);
  for (const Shorthand& shorthand : shorthands) {
    const std::string otherwise = shorthand.otherwise;
    if (!otherwise.empty()) ApplyOverrides(shorthand.key + ("=" + otherwise), &base);
  }
  RunConfig config = base;
  ApplyOverrides(settings, &config);
  const RunConfig by_set = config;
  for (const Shorthand& shorthand : shorthands) {
    const auto flag = gflags::GetCommandLineFlagInfoOrDie(shorthand.flag);
    if (flag.is_default) continue;
    const std::string name = std::string("--") + shorthand.flag;
    const std::string setting = shorthand.key + ("=" + ValueOf(flag));
    ApplyOverrides(setting, &config, name);
    // Where both say the same, or --set says nothing of it, their order does not matter.
    RunConfig first = base, last = by_set;
    ApplyOverrides(setting, &first, name);
    ApplyOverrides(settings, &first);
    ApplyOverrides(setting, &last, name);
    if (DumpConfig(first) == DumpConfig(last)) continue;
    throw UsageError(name + "=" + flag.current_value + " sets " + shorthand.key +
                     ", and --set gives it another value");
  }
  MakePathsAbsolute(&config);
  return config;
}

}  // namespace trajlo
