// SPDX-License-Identifier: MIT
#include "core/report/versions.h"

#include <ceres/version.h>

#include <Eigen/Core>

#include "trajlo_git_version.h"

namespace trajlo {

Versions GetVersions() {
  const auto dotted = [](int a, int b, int c) {
    return std::to_string(a) + "." + std::to_string(b) + "." + std::to_string(c);
  };
  Versions versions;
  versions.trajlo = TRAJLO_VERSION;
  versions.git = TRAJLO_GIT_COMMIT;
  versions.eigen = dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
  versions.ceres = CERES_VERSION_STRING;
#if defined(__clang__)
  versions.compiler = std::string("clang ") + __clang_version__;
#else
  versions.compiler = std::string("g++ ") + __VERSION__;
#endif
  return versions;
}

}  // namespace trajlo
