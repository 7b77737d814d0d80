// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"

namespace trajlo {

/// A flag that is short for an option: --solver for solver.kind.
struct Shorthand {
  const char* flag;
  const char* key;
  /// Not empty: what the option is, whatever --config says, unless the flag or --set changes it.
  const char* otherwise = "";
};

/// The defaults, changed by --config (see FindConfig) in its order, then by --set and by the
/// shorthands that are given. CheckConfig() is left to the caller, who may change more. Throws
/// ConfigError; UsageError if a shorthand and --set contradict each other.
RunConfig LoadConfig(const std::string& files, const std::string& settings,
                     const std::vector<Shorthand>& shorthands = {});

}  // namespace trajlo
