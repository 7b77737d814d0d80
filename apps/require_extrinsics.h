// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"

namespace trajlo {

/// Throws UsageError if sensor.T_body_lidar does not have one pose for each LiDAR that is read, or
/// none for the only one: taken to sit in one place, or where another one sits, they give a wrong
/// trajectory without any complaint.
void RequireExtrinsics(const std::vector<std::string>& inputs, const RunConfig& config);

/// Throws UsageError if an option of `input` that can be a list has neither one value nor one for
/// each LiDAR that is read, or if a file of stamps is given for several folders, or for messages.
void RequireOptionsOfEachLidar(const std::vector<std::string>& inputs,
                               const RecordingOptions& options);

}  // namespace trajlo
