// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <string>
#include <string_view>

#include "core/config/option.h"
#include "core/io/number_text.h"
#include "core/options/number_text.h"

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

}  // namespace trajlo
