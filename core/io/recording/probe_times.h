// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/time_probe.h"

namespace trajlo {

/// Reads until each of the probes, one for each of `topics`, is complete, but not for ever: a LiDAR
/// that says nothing for long is decided without evidence. Returns the frame of each topic's first
/// cloud.
std::vector<std::string> ProbeTimes(const std::vector<std::size_t>& topics,
                                    CloudMessageReader* reader, std::vector<TimeProbe>* probes);

}  // namespace trajlo
