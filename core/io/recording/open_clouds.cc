// SPDX-License-Identifier: MIT
#include "core/io/recording/open_clouds.h"

#include "core/io/errors.h"

namespace trajlo {

bool HoldsClouds(const std::filesystem::path&) { return false; }

std::unique_ptr<CloudMessageReader> OpenClouds(const std::filesystem::path& path) {
  throw InputError(path, "", "");
}

}  // namespace trajlo
