// SPDX-License-Identifier: MIT
#include "core/odometry/segments/voxel_filter.h"

#include <cmath>

namespace trajlo {
namespace {

/// 21 bits an axis, offset so that negative cells are positive numbers.
std::uint64_t CellKey(const Eigen::Vector3f& p, float inverse_size) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(p[axis] * inverse_size)) + (1 << 20);
    key = (key << 21) | (static_cast<std::uint64_t>(cell) & 0x1FFFFF);
  }
  return key;
}

/// No cell has it: 63 bits are used.
constexpr std::uint64_t kFree = ~std::uint64_t{0};

}  // namespace

void VoxelFilter::Filter(const std::vector<SegmentPoint>& input,
                         std::vector<SegmentPoint>* output) {
  output->clear();
  output->reserve(input.size());
  int bits = 10;
  while ((std::size_t{1} << bits) < 2 * input.size()) ++bits;
  table_.assign(std::size_t{1} << bits, kFree);
  const std::size_t mask = table_.size() - 1;
  std::uint64_t last = kFree;
  for (const SegmentPoint& point : input) {
    const std::uint64_t key = CellKey(point.p_body_m, inverse_size_);
    if (key == last) continue;
    last = key;
    // Fibonacci hashing: the upper bits of a product with 2^64 over the golden ratio.
    std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> (64 - bits);
    while (table_[slot] != kFree && table_[slot] != key) slot = (slot + 1) & mask;
    if (table_[slot] == key) continue;
    table_[slot] = key;
    output->push_back(point);
  }
}

}  // namespace trajlo
