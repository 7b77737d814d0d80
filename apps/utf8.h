// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace trajlo {

bool IsUtf8(const std::string& text);

/// Summaries and tables are UTF-8, and could not name what a word stands for that is none. Throws
/// UsageError for the first such word.
void RequireUtf8(const std::vector<std::string>& words);

}  // namespace trajlo
