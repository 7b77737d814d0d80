// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>

namespace trajlo {

/// True for --help, -help and -h. To be asked ahead of gflags, whose own help lists the flags of
/// every library that is linked.
inline bool WantsHelp(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    for (const char* flag : {"--help", "-help", "-h"}) {
      if (std::strcmp(argv[i], flag) == 0) return true;
    }
  }
  return false;
}

}  // namespace trajlo
