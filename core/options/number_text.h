// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace trajlo {

/// The shortest text that reads back as the same double, with a decimal point, without which
/// some YAML readers take 1e-06 for a word.
inline std::string NumberText(double value) {
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof(buffer), value);
  std::string text(buffer, error == std::errc() ? end : buffer);
  if (text.find_first_of(".n") == std::string::npos) {  // Neither nan nor inf has a point.
    const std::size_t exponent = text.find('e');
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

/// What a number of a range may be, in words.
inline std::string RangeText(double min, double max) {
  return "a number from " + NumberText(min) + " to " + NumberText(max);
}
inline std::string RangeText(int min, int max) {
  return "a whole number from " + std::to_string(min) + " to " + std::to_string(max);
}

}  // namespace trajlo
