// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "core/config/config.h"

namespace trajlo::testing {

/// The message of the ConfigError that `action` throws; empty if it throws none.
inline std::string ConfigErrorOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

inline std::string LoadingError(const std::string& yaml) {
  return ConfigErrorOf([&] {
    RunConfig config;
    LoadConfigText(yaml, "my.yaml", &config);
  });
}

inline std::string OverrideError(const std::string& settings) {
  return ConfigErrorOf([&] {
    RunConfig config;
    ApplyOverrides(settings, &config);
  });
}

inline RunConfig Loaded(const std::string& yaml) {
  RunConfig config;
  LoadConfigText(yaml, "my.yaml", &config);
  return config;
}

inline RunConfig Overridden(const std::string& settings) {
  RunConfig config;
  ApplyOverrides(settings, &config);
  return config;
}

}  // namespace trajlo::testing
