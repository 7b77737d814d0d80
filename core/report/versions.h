// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace trajlo {

/// What a result was made with.
struct Versions {
  std::string trajlo;    ///< "0.1.0"
  std::string git;       ///< The commit at build time, "-dirty" if it was changed; or "unknown".
  std::string eigen;     ///< "3.4.0"
  std::string ceres;     ///< "2.1.0-eigen-..."
  std::string compiler;  ///< "g++ 12.2.0"
};

Versions GetVersions();

}  // namespace trajlo
