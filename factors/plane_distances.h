// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "factors/registration_lanes.h"

namespace trajlo {

/// Calls f(point, distance_m) for every `stride`-th point of a segment that moves by `motion`: how
/// far it is from its plane, nᵀ phi(alpha) p - d. Four points at a time.
template <typename F>
void ForEachDistance(const std::vector<RegistrationPoint>& points, const SegmentMotion& motion,
                     std::size_t stride, F f) {
  using registration_lanes::kLanes;
  const std::size_t asked = (points.size() + stride - 1) / stride;
  for (std::size_t first = 0; first < asked; first += kLanes) {
    const RegistrationPoint* group = &points[first * stride];
    const std::size_t count = std::min<std::size_t>(kLanes, asked - first);
    const registration_lanes::LocatedPoints at(registration_lanes::Gather(group, count, stride),
                                               motion);
    for (std::size_t i = 0; i < count; ++i) f(group[i * stride], at.r[i]);
  }
}

}  // namespace trajlo
