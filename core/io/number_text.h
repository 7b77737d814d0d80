// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace trajlo {

/// Parses a whole word as a number, whatever the locale: "1", "+1.5", "-2e-3", "nan", "inf".
/// Returns false, with `value` unspecified, if anything of the word is left over.
template <typename Number>
bool ParseNumber(std::string_view word, Number* value) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, *value);
  return error == std::errc() && stop == end;
}

/// Parses a whole word as a number without a sign.
inline std::optional<std::uint64_t> ParseWhole(std::string_view word) {
  std::uint64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return {};
  return value;
}

}  // namespace trajlo
