// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "apps/exit_code.h"

namespace trajlo {

struct InfoRequest {
  std::vector<std::string> recordings;
  bool json = false;
  /// Only the first messages of each LiDAR.
  bool quick = false;
  bool quiet = false;
};

/// Prints what the recordings hold; what cannot be read is said on stderr, and the rest goes on.
ExitCode InfoJob(const InfoRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
