// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <string>
#include <system_error>

namespace trajlo {

/// A line of a table: names and values are added together, so that they cannot get apart.
class CsvRow {
 public:
  void Add(const char* name, const std::string& value) {
    names_ += (names_.empty() ? "" : ",") + std::string(name);
    values_ += (values_.empty() ? "" : ",") + value;
  }
  template <typename Number>
  void Add(const char* name, Number value) {
    char text[40];
    const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
    Add(name, std::string(text, error == std::errc() ? end : text));
  }

  std::string Names() const { return names_ + "\n"; }
  std::string Values() const { return values_ + "\n"; }

 private:
  std::string names_, values_;
};

}  // namespace trajlo
