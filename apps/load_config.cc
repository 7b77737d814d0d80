// SPDX-License-Identifier: MIT
#include "apps/load_config.h"

#include "apps/config_names.h"
#include "apps/split_at_commas.h"

namespace trajlo {

RunConfig LoadConfig(const std::string& files, const std::string& settings) {
  RunConfig config;
  for (const std::string& file : SplitAtCommas(files)) LoadConfigFile(FindConfig(file), &config);
  ApplyOverrides(settings, &config);
  return config;
}

}  // namespace trajlo
