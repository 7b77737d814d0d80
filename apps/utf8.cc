// SPDX-License-Identifier: MIT
#include "apps/utf8.h"

#include <nlohmann/json.hpp>

#include "apps/usage_error.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

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
  try {
    nlohmann::json(text).dump();
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
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
