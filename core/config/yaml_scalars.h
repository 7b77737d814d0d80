// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "core/config/option.h"
#include "core/io/number_text.h"

namespace trajlo {

/// A ValueError at the place of `node`.
inline ValueError ErrorAt(const YAML::Node& node, const std::string& what) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? ValueError{what, 0, 0} : ValueError{what, mark.line + 1, mark.column + 1};
}

/// Parses the whole text as a number whatever the locale; false if it is none, or not finite.
template <typename Number>
bool ParseFinite(std::string_view text, Number* number) {
  return ParseNumber(text, number) && std::isfinite(static_cast<double>(*number));
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
