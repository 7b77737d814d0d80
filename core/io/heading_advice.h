// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "core/io/ascii_table.h"
#include "core/io/number_text.h"

namespace trajlo {

/// What mends the first line of a table of numbers that may be a heading, as the end of a text;
/// empty if the line begins with a number.
inline std::string HeadingAdvice(std::string_view first_line) {
  double number = 0.0;
  if (ParseNumber(TakeWord(&first_line), &number)) return "";
  return " If that line is a heading, begin the line with #.";
}

}  // namespace trajlo
