// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/command.h"

namespace trajlo {

/// The recordings to read: the arguments, or what --input says, with the LiDARs of a folder one by
/// one. Throws UsageError if both are given, if neither is, and on an argument that is not there.
std::vector<std::string> InputsOf(const CommandLine& line, const std::string& flag);

}  // namespace trajlo
