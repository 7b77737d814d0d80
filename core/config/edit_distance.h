// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trajlo {

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn a into b.
int EditDistance(std::string_view a, std::string_view b);

/// The candidate that `word` most likely stands for: by the whole dotted key, or by its last part
/// alone when the section was forgotten or is another one. Empty if none is close.
std::string NearestKey(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace trajlo
