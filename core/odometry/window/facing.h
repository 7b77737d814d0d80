// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/window/association.h"
#include "factors/registration_point.h"

namespace trajlo {

/// Whether a plane faces a direction (a unit vector in the world): its points tell how far one has
/// moved along it.
inline bool IsFacing(const RegistrationPoint& point, const Eigen::Vector3d& direction) {
  constexpr double kFacing = 0.5;
  return std::abs(point.normal_world.dot(direction)) >= kFacing;
}

/// Those of `all` points that may tell how far one has moved along `direction`: all but those on
/// planes that do not face it. About `holding` of these (at most twice as many) remain to hold the
/// rest of the motion. `with_plane` are those of `all` that have a plane, in the same order.
inline std::vector<SegmentPoint> TellingAlong(const Eigen::Vector3d& direction,
                                              const std::vector<RegistrationPoint>& with_plane,
                                              const std::vector<SegmentPoint>& all,
                                              std::size_t holding) {
  std::vector<SegmentPoint> telling, others;
  auto next = with_plane.begin();
  for (const SegmentPoint& point : all) {
    const bool has_plane = next != with_plane.end() && IsSamePoint(*next, point);
    (has_plane && !IsFacing(*next, direction) ? others : telling).push_back(point);
    if (has_plane) ++next;
  }
  const std::size_t stride = std::max<std::size_t>(1, others.size() / holding);
  for (std::size_t i = 0; i < others.size(); i += stride) telling.push_back(others[i]);
  return telling;
}

}  // namespace trajlo
