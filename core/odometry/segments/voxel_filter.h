// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"

namespace trajlo {

/// Keeps the first point of every cell of a cubic grid, in input order, with its time.
/// The cell of a coordinate is floor(coordinate / size). Reuses its table: no allocation in steady
/// state. Coordinates must be finite and within ±1e6 cells.
class VoxelFilter {
 public:
  explicit VoxelFilter(double size_m) : inverse_size_(static_cast<float>(1.0 / size_m)) {}

  /// `output` is cleared first.
  void Filter(const std::vector<SegmentPoint>& input, std::vector<SegmentPoint>* output);

 private:
  float inverse_size_;
  std::vector<std::uint64_t> table_;  ///< The keys of the cells that are taken.
};

}  // namespace trajlo
