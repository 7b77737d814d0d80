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

template <typename Visit>
void VoxelFilter::ForEach(const std::vector<SegmentPoint>& input, const Visit& visit) {
  int bits = 10;
  while ((std::size_t{1} << bits) < 2 * input.size()) ++bits;
  table_.assign(std::size_t{1} << bits, kFree);
  const std::size_t mask = table_.size() - 1;
  std::uint64_t last = kFree;
  for (std::size_t i = 0; i < input.size(); ++i) {
    const std::uint64_t key = CellKey(input[i].p_body_m, inverse_size_);
    bool is_first = false;
    if (key != last) {
      last = key;
      // Fibonacci hashing: the upper bits of a product with 2^64 over the golden ratio.
      std::size_t slot = (key * 0x9E3779B97F4A7C15ULL) >> (64 - bits);
      while (table_[slot] != kFree && table_[slot] != key) slot = (slot + 1) & mask;
      is_first = table_[slot] == kFree;
      table_[slot] = key;
    }
    visit(i, is_first);
  }
}

void VoxelFilter::Filter(const std::vector<SegmentPoint>& input,
                         std::vector<SegmentPoint>* output) {
  output->clear();
  output->reserve(input.size());
  ForEach(input, [&](std::size_t i, bool is_first) {
    if (is_first) output->push_back(input[i]);
  });
}

void VoxelFilter::Split(const std::vector<SegmentPoint>& input, std::vector<std::size_t>* first,
                        std::vector<std::size_t>* others) {
  first->clear();
  others->clear();
  ForEach(input, [&](std::size_t i, bool is_first) { (is_first ? first : others)->push_back(i); });
}

}  // namespace trajlo
