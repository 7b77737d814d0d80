// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/scans/nanoseconds.h"

namespace trajlo::simulation {

/// The offset closest to this that survives being written as float32 seconds, as Velodyne's driver
/// and our PCD files have it, and read back to whole ns. Within a sweep of 0.1 s it is 4 ns off at
/// most; so all forms of a recording hold the same times.
inline std::int64_t StorableOffsetNs(std::int64_t offset_ns) {
  return Nanoseconds(static_cast<double>(static_cast<float>(Seconds(offset_ns))));
}

}  // namespace trajlo::simulation
