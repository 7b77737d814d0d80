// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "core/io/ascii_table.h"

namespace trajlo {

/// Walks over the lines of a text file that say something: no byte order mark, no line ends, no
/// blanks in front, neither blank lines nor lines that begin with #.
class MeaningfulLines {
 public:
  explicit MeaningfulLines(std::string_view text) : text_(text) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
  }

  bool Next(std::string_view* line) {
    while (TakeLine(&text_, line)) {
      ++number_;
      const std::size_t begin = line->find_first_not_of(" \t\r");
      if (begin == std::string_view::npos || (*line)[begin] == '#') continue;
      line->remove_prefix(begin);
      return true;
    }
    return false;
  }
  /// The number of the line that Next() gave, from 1.
  std::size_t number() const { return number_; }
  /// True if nothing is behind that line, not even lines that say nothing.
  bool at_end() const { return text_.empty(); }

 private:
  std::string_view text_;
  std::size_t number_ = 0;
};

}  // namespace trajlo
