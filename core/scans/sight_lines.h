// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/scans/lidar_scan.h"

namespace trajlo {

/// What a LiDAR sees hides what is behind it. So hardly any direction shows two things, one behind
/// the other, unless the points are not in the frame of the LiDAR: clouds that were registered
/// already, or joined from several places.
///
/// A direction is a cell of 0.02 rad. It is asked if it holds four points or more, and shows two
/// things if two of them are at least 1.2 times as far as two others: a drop of rain is no thing.
/// Of scans as measured, 0.00 to 0.13 of the directions do (edges and leaves; 0.13 in KITTI's
/// streets, and in a wood with a tenth of the points in the air). Of registered clouds, 0.21 to
/// 0.56 do, and 0.03 where the LiDAR hardly leaves the place at which it began.
struct SightLines {
  std::int64_t asked = 0;
  std::int64_t with_two_things = 0;

  /// Looks along an eighth of the directions of a scan.
  void Add(const LidarScan& scan);
  /// The share of the directions with two things.
  double Share() const;
  /// Whether the points cannot have been seen from the origin of their frame.
  bool AreCrossed() const;
};

}  // namespace trajlo
