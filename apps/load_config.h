// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/config/config.h"

namespace trajlo {

/// The defaults, changed by --config (see FindConfig) in its order, then by --set. CheckConfig() is
/// left to the caller, whose other flags may change more. Throws ConfigError.
RunConfig LoadConfig(const std::string& files, const std::string& settings);

}  // namespace trajlo
