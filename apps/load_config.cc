// SPDX-License-Identifier: MIT
#include "apps/load_config.h"

#include "apps/split_at_commas.h"

namespace trajlo {

RunConfig LoadConfig(const std::string& files, const std::string& settings) {
  RunConfig config;
  for (const std::string& file : SplitAtCommas(files)) LoadConfigFile(file, &config);
  ApplyOverrides(settings, &config);
  return config;
}

}  // namespace trajlo
