// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace trajlo {

/// A line of a table: names and values are added together, so that they cannot get apart.
class CsvRow {
 public:
  void Add(const char* name, std::string_view value) {
    Append(name, &names_);
    Append(value, &values_);
  }
  template <typename Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void Add(const char* name, Number value) {
    char text[40];
    const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
    Add(name,
        std::string_view(text, error == std::errc() ? static_cast<std::size_t>(end - text) : 0));
  }

  std::string Names() const { return names_ + "\n"; }
  std::string Values() const { return values_ + "\n"; }

 private:
  static void Append(std::string_view text, std::string* line) {
    if (!line->empty()) *line += ',';
    *line += text;
  }

  std::string names_, values_;
};

}  // namespace trajlo
