// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "core/config/option.h"

namespace trajlo {

/// A ValueError at the place of `node`.
inline ValueError ErrorAt(const YAML::Node& node, const std::string& what) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? ValueError{what, 0, 0} : ValueError{what, mark.line + 1, mark.column + 1};
}

/// Parses the whole text as a number whatever the locale; false if it is none, or not finite.
template <typename Number>
bool ParseNumber(std::string_view text, Number* number) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, *number);
  return error == std::errc() && at == end && std::isfinite(static_cast<double>(*number));
}

/// The shortest text that reads back as the same double, with a decimal point, without which
/// some YAML readers take 1e-06 for a word.
inline std::string NumberText(double value) {
  char buffer[40];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof(buffer), value);
  std::string text(buffer, error == std::errc() ? end : buffer);
  if (text.find('.') == std::string::npos) {
    const std::size_t exponent = text.find('e');
    text.insert(exponent == std::string::npos ? text.size() : exponent, ".0");
  }
  return text;
}

}  // namespace trajlo
