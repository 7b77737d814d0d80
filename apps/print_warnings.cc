// SPDX-License-Identifier: MIT
#include "apps/print_warnings.h"

#include <cstddef>
#include <cstdio>

#include "core/io/format_text.h"

namespace trajlo {

void PrintWarnings(const char* command, const std::vector<std::string>& warnings,
                   const char* the_rest) {
  constexpr std::size_t kPrinted = 10;
  for (std::size_t i = 0; i < warnings.size() && i < kPrinted; ++i) {
    std::fprintf(stderr, "%s: warning: %s\n", command, warnings[i].c_str());
  }
  if (warnings.size() <= kPrinted) return;
  std::fprintf(stderr, "%s: %s%s\n", command,
               CountOf(warnings.size() - kPrinted, "more warning").c_str(), the_rest);
}

}  // namespace trajlo
