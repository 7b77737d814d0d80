// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/comparison/forms/ceres_form_options.h"
#include "core/config/config_error.h"
#include "core/io/recording/recording_options.h"
#include "core/odometry/odometry_options.h"

namespace trajlo {

/// All that a run can be told, with the defaults of the structs that it is made of. Each option has
/// a dotted key such as `window.segments`, under which it stands in YAML as nested maps.
struct RunConfig {
  RecordingOptions input;
  OdometryOptions odometry;
  CeresFormOptions ceres_form;
};

/// Sets what the YAML file says and leaves all else as it is, so that several files can be loaded
/// one over the other. Throws ConfigError with file, line and column on an unreadable file, an
/// unknown key (naming the nearest), a repeated key, a wrong type, and a value out of range.
/// Relative paths that it names are below its own folder, and become absolute.
void LoadConfigFile(const std::filesystem::path& path, RunConfig* config);

/// The same for what a run wrote down of itself, maybe by an older build: returns the unknown keys
/// in place of refusing them.
std::vector<std::string> LoadRecordedConfig(const std::filesystem::path& path, RunConfig* config);

/// As LoadConfigFile for YAML in memory; `name` stands for the file in messages.
void LoadConfigText(const std::string& yaml, const std::string& name, RunConfig* config);

/// The same for options that a program hands over: messages name no line, as the user wrote none.
void LoadConfigValues(const std::string& yaml, const std::string& name, RunConfig* config);

/// Sets "key=value,key=value"; values are written as in YAML, and commas within brackets belong to
/// the value. Throws ConfigError; `name` stands for the origin of the text in messages.
void ApplyOverrides(std::string_view settings, RunConfig* config,
                    const std::string& name = "--set");

/// Throws ConfigError if options that are fine each by itself contradict each other.
void CheckConfig(const RunConfig& config);

/// Which options a dump has.
enum class DumpedOptions {
  kAll,
  kForUsers,    ///< Those that do not begin with `expert.`.
  kForExperts,  ///< Those that do.
};

/// The configuration as commented YAML. Loading a whole one gives the same values to the last bit.
std::string DumpConfig(const RunConfig& config, DumpedOptions options = DumpedOptions::kAll);

/// One option, for sweeps and for help.
struct KeyInfo {
  std::string key;            ///< "window.segments"
  std::string allowed;        ///< "a whole number from 1 to 20", "true or false", "ceres | ..."
  std::string default_value;  ///< As YAML.
  std::string doc;            ///< One sentence.
  /// The words that it may be; empty where numbers or any text may stand.
  std::vector<std::string> choices;
};

/// Every option, in the order of the dump.
std::vector<KeyInfo> ListKeys();

}  // namespace trajlo
