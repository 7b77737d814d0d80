// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "apps/exit_code.h"
#include "core/io/packets/velodyne_model.h"

namespace trajlo {

struct InfoRequest {
  std::vector<std::string> recordings;
  bool json = false;
  /// Only the first messages of each LiDAR.
  bool quick = false;
  bool quiet = false;
  /// Put before the command that is advised: "build/apps/" for programs that are not in PATH.
  std::string program_folder;
  /// Of packets that do not name it.
  std::optional<VelodyneModel> velodyne_model;
};

/// Prints what the recordings hold; what cannot be read is said on stderr, and the rest goes on.
ExitCode InfoJob(const InfoRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
