// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"

namespace trajlo {

/// Finds the first point of every cell of a cubic grid, in input order.
/// The cell of a coordinate is floor(coordinate / size). Reuses its table: no allocation in steady
/// state. Coordinates must be finite and within ±1e6 cells.
class VoxelFilter {
 public:
  explicit VoxelFilter(double size_m) : inverse_size_(static_cast<float>(1.0 / size_m)) {}

  /// Keeps the first points; `output` is cleared before.
  void Filter(const std::vector<SegmentPoint>& input, std::vector<SegmentPoint>* output);
  /// Tells them from the others, by their indices; both lists are cleared before.
  void Split(const std::vector<SegmentPoint>& input, std::vector<std::size_t>* first,
             std::vector<std::size_t>* others);

 private:
  /// Calls visit(index, is_first) for every point.
  template <typename Visit>
  void ForEach(const std::vector<SegmentPoint>& input, const Visit& visit);

  float inverse_size_;
  std::vector<std::uint64_t> table_;  ///< The keys of the cells that are taken.
};

}  // namespace trajlo
