// SPDX-License-Identifier: MIT
#include "core/comparison/solver_variant.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "core/config/config_file.h"

namespace trajlo {
namespace {

std::string Where(const std::filesystem::path& path, const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? path.string() : path.string() + ":" + std::to_string(mark.line + 1);
}

/// Name and settings, as they are written.
SolverVariant ReadVariant(const std::filesystem::path& path, const YAML::Node& item) {
  if (!item.IsMap() || !item["name"] || !item["name"].IsScalar() ||
      (item["set"] && !item["set"].IsScalar())) {
    throw ConfigError(Where(path, item), "a variant is {name: ..., set: \"key=value,...\"}");
  }
  for (const auto& entry : item) {
    const auto key = entry.first.as<std::string>();
    if (key == "name" || key == "set") continue;
    throw ConfigError(Where(path, item), "unknown key '" + key +
                                             "'; a variant is {name: ..., set: \"key=value,...\"}");
  }
  SolverVariant variant;
  variant.name = item["name"].as<std::string>();
  if (item["set"]) variant.settings = item["set"].as<std::string>();
  return variant;
}

/// Each variant has a folder of its own.
void CheckName(const std::string& name, const std::vector<SolverVariant>& others,
               const std::string& where) {
  const bool is_file_name =
      !name.empty() && name[0] != '.' && name.find_first_of("/,\"\n") == std::string::npos;
  const bool is_new = std::none_of(others.begin(), others.end(),
                                   [&](const auto& other) { return other.name == name; });
  if (is_file_name && is_new) return;
  throw ConfigError(
      where, "the name '" + name + "' " +
                 (is_new ? "must not begin with a dot, nor hold / , or \"" : "appears twice"));
}

/// Applies the settings to `base`.
void Set(const RunConfig& base, const std::string& where, SolverVariant* variant) {
  RunConfig config = base;
  ApplyOverrides(variant->settings, &config, where);
  CheckConfig(config);
  RunConfig same_input = config;
  same_input.input = base.input;
  if (DumpConfig(same_input) != DumpConfig(config)) {
    throw ConfigError(where,
                      "all variants read the recording alike: give input.* to the command (--set)");
  }
  variant->odometry = config.odometry;
  variant->ceres_form = config.ceres_form;
}

}  // namespace

std::vector<SolverVariant> LoadVariants(const std::filesystem::path& path, const RunConfig& base) {
  YAML::Node root;
  try {
    root = YAML::Load(ReadConfigFile(path));
  } catch (const YAML::Exception& error) {
    throw ConfigError(path.string() + ":" + std::to_string(error.mark.line + 1),
                      "this is not valid YAML: " + error.msg);
  }
  const YAML::Node list = root.IsMap() ? root["variants"] : YAML::Node();
  if (!list || !list.IsSequence() || list.size() == 0) {
    throw ConfigError(path.string(),
                      "expected 'variants:' with a list of {name: ..., set: \"key=value,...\"}");
  }
  std::vector<SolverVariant> variants;
  for (const YAML::Node& item : list) {
    SolverVariant variant = ReadVariant(path, item);
    CheckName(variant.name, variants, Where(path, item));
    Set(base, Where(path, item), &variant);
    variants.push_back(std::move(variant));
  }
  return variants;
}

bool IsAboutOneWindow(const SolverVariant& variant, const RunConfig& base) {
  RunConfig same = base;
  same.odometry = variant.odometry;
  same.odometry.solver = base.odometry.solver;
  same.odometry.registration.kernel = base.odometry.registration.kernel;
  same.odometry.marginalization.first_estimate_jacobians =
      base.odometry.marginalization.first_estimate_jacobians;
  return DumpConfig(same) == DumpConfig(base);
}

}  // namespace trajlo
