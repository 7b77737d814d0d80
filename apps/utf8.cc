// SPDX-License-Identifier: MIT
#include "apps/utf8.h"

#include <algorithm>

#include "apps/usage_error.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

/// How many bytes a character has that begins with this one; 0: none does.
std::size_t LengthOf(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

bool IsContinuation(char c) { return (static_cast<unsigned char>(c) >> 6) == 2; }

/// The range of the second byte keeps out surrogates, longer forms, and what is beyond Unicode.
bool IsSecond(unsigned char first, unsigned char second) {
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second < 0xA0;
  if (first == 0xF0) return second >= 0x90;
  return first != 0xF4 || second < 0x90;
}

std::string Printable(const std::string& text) {
  std::string printable;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    printable += byte < 0x80 ? std::string(1, c) : FormatText("\\x%02x", byte);
  }
  return printable;
}

}  // namespace

bool IsUtf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = LengthOf(first);
    if (length == 0 || i + length > text.size()) return false;
    const auto rest = text.begin() + static_cast<std::ptrdiff_t>(i);
    const auto end = rest + static_cast<std::ptrdiff_t>(length);
    if (!std::all_of(rest + 1, end, IsContinuation)) return false;
    if (length > 1 && !IsSecond(first, static_cast<unsigned char>(text[i + 1]))) return false;
    i += length;
  }
  return true;
}

void RequireUtf8(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (IsUtf8(word)) continue;
    throw UsageError("'" + Printable(word) +
                     "' is not UTF-8, and no result could name it; rename it, or make a link to it "
                     "(ln -s) with a name in UTF-8");
  }
}

}  // namespace trajlo
