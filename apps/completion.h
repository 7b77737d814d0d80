// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/command.h"

namespace trajlo {

/// What may stand in place of the half-typed `word`, whole words: flags, and the values of those
/// flags whose values are known. `previous` is the word before. Empty where a file is expected.
std::vector<std::string> Complete(const Command& command, const std::string& previous,
                                  const std::string& word);

/// What a shell has to run once to complete all commands, for "bash" or "zsh". Throws UsageError.
std::string CompletionScript(const std::string& shell);

}  // namespace trajlo
