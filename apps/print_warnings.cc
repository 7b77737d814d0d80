// SPDX-License-Identifier: MIT
#include "apps/print_warnings.h"

#include <cstddef>
#include <cstdio>

namespace trajlo {

void PrintWarnings(const char* command, const std::vector<std::string>& warnings,
                   const char* the_rest) {
  constexpr std::size_t kPrinted = 10;
  for (std::size_t i = 0; i < warnings.size() && i < kPrinted; ++i) {
    std::fprintf(stderr, "%s: warning: %s\n", command, warnings[i].c_str());
  }
  if (warnings.size() <= kPrinted) return;
  std::fprintf(stderr, "%s: %zu more warnings%s\n", command, warnings.size() - kPrinted, the_rest);
}

}  // namespace trajlo
