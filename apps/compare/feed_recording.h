// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/compare/compare_request.h"
#include "core/odometry/odometry.h"

namespace trajlo {

/// What became of a recording, and what is to be said of it.
struct Feed {
  double wall_s = 0.0;
  std::optional<std::int64_t> lost_at_ns;
  /// See RunSummary.
  std::string shortcomings;
  std::vector<std::string> warnings;
};

/// Takes a whole recording to the odometry, or what is read of it until `stop`. The progress bar
/// shows `name` and `inlier_share`. Throws InputError.
Feed FeedRecording(const CompareRequest& request, const std::string& name,
                   const std::atomic<bool>& stop, const double& inlier_share, Odometry* odometry);

}  // namespace trajlo
