// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string_view>

namespace trajlo {

/// Parses a whole word as a number, whatever the locale: "1", "+1.5", "-2e-3", "nan", "inf".
/// Returns false, with `value` unspecified, if anything of the word is left over.
inline bool ParseNumber(std::string_view word, double* value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, *value);
  return error == std::errc() && stop == end;
}

}  // namespace trajlo
