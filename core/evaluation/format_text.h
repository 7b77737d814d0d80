// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>

namespace trajlo {

/// printf into a string; longer than 500 characters it is cut.
template <typename... Values>
std::string FormatText(const char* format, Values... values) {
  char text[500];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

}  // namespace trajlo
