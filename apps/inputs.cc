// SPDX-License-Identifier: MIT
#include "apps/inputs.h"

#include <filesystem>

#include "apps/usage_error.h"
#include "core/io/recording/open_recording.h"

namespace trajlo {

std::vector<std::string> InputsOf(const CommandLine& line, const std::string& flag) {
  if (!flag.empty()) RequireNoArguments(line);
  if (flag.empty() && line.arguments.empty()) {
    throw UsageError("no recording given: " + line.command + " RECORDING -o RESULT");
  }
  if (!flag.empty()) return InputPaths(flag);
  std::vector<std::string> inputs;
  std::error_code error;
  for (const std::string& argument : line.arguments) {
    if (line.arguments.size() > 1 && !std::filesystem::exists(argument, error)) {
      throw UsageError("there is no recording '" + argument + "'; to write there: -o " + argument);
    }
    for (const std::string& path : InputPaths(argument)) inputs.push_back(path);
  }
  return inputs;
}

}  // namespace trajlo
