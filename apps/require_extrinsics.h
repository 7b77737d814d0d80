// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/config/config.h"

namespace trajlo {

/// Throws UsageError if several LiDARs are read and sensor.T_body_lidar does not say of each where
/// it sits: taken to sit in one place they give a wrong trajectory without any complaint.
void RequireExtrinsics(const std::vector<std::string>& inputs, const RunConfig& config);

}  // namespace trajlo
