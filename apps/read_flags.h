// SPDX-License-Identifier: MIT
#pragma once

#include <gflags/gflags.h>

#include <string>
#include <string_view>
#include <vector>

namespace trajlo {

/// Reads a command line into gflags' FLAGS_ variables and returns the arguments, which are all
/// words that belong to no flag. `words` begins with the name of the program.
///
/// A flag is written --name=value, --name value, or -o value for the short names; one or two
/// dashes, `-` or `_` within the name. --quiet and --noquiet switch. Flags that take lists may be
/// repeated. Behind `--` there are arguments only. Throws UsageError.
std::vector<std::string> ReadFlags(const std::string& command,
                                   const std::vector<std::string>& words);

/// The flags of a command: those that its source file defines, not those of libraries.
std::vector<gflags::CommandLineFlagInfo> FlagsOf(const std::string& command);

/// "output" for "o", "start_s" for "start-s".
std::string LongName(std::string_view name);

/// True for flags that hold a list, which may be given in parts: --set a=1 --set b=2.
bool IsList(const std::string& flag);

}  // namespace trajlo
