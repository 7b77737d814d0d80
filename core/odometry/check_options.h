// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/odometry_options.h"

namespace trajlo {

/// Throws std::invalid_argument if an option is out of its range (or NaN), or if options contradict
/// each other that are fine each by itself. The message names them by their keys, which are those
/// of a configuration ("expert.segmenter.max_gap_s" is OdometryOptions::segmenter.max_gap_s), and
/// says what they are and what they may be.
void CheckOptions(const OdometryOptions& options);

}  // namespace trajlo
