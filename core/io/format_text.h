// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <string>

namespace trajlo {

/// printf into a string of any length.
[[gnu::format(printf, 1, 2)]] inline std::string FormatText(const char* format, ...) {
  std::va_list values, again;
  va_start(values, format);
  va_copy(again, values);
  const int size = std::max(0, std::vsnprintf(nullptr, 0, format, values));
  va_end(values);
  std::string text(static_cast<std::size_t>(size), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

/// "1 scan", "2 scans"; "1 scan is" with `many` "scans are", "2 scans are".
template <typename Integer>
std::string CountOf(Integer count, const std::string& one, const std::string& many = {}) {
  const std::string text = std::to_string(count) + " ";
  if (count == 1) return text + one;
  return text + (many.empty() ? one + "s" : many);
}

}  // namespace trajlo
