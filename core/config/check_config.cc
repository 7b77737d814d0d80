// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "core/config/config.h"
#include "core/odometry/check_options.h"

namespace trajlo {

void CheckConfig(const RunConfig& config) {
  try {
    CheckOptions(config.odometry);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(error.what());
  }
}

}  // namespace trajlo
