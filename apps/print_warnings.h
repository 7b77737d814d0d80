// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace trajlo {

/// Prints the first ten to stderr, and how many more there are. `command` is "trajlo_run";
/// `the_rest` says where the others stand, as in " are in run.json".
void PrintWarnings(const char* command, const std::vector<std::string>& warnings,
                   const char* the_rest = "");

}  // namespace trajlo
