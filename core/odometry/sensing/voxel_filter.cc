// SPDX-License-Identifier: MIT
#include "core/odometry/sensing/voxel_filter.h"

#include <algorithm>
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

/// The finaliser of SplitMix64.
std::uint64_t Mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

}  // namespace

void VoxelFilter::Filter(const std::vector<SegmentPoint>& input,
                         std::vector<SegmentPoint>* output) {
  output->clear();
  std::size_t size = std::max<std::size_t>(table_.size(), 1024);
  while (size < 2 * input.size()) size *= 2;
  if (size != table_.size()) {
    table_.assign(size, Cell{});
    round_ = 0;
  }
  if (++round_ == 0) {  // The counter wrapped around: every mark is stale.
    std::fill(table_.begin(), table_.end(), Cell{});
    round_ = 1;
  }
  const std::size_t mask = table_.size() - 1;
  for (const SegmentPoint& point : input) {
    const std::uint64_t key = CellKey(point.p_body_m, inverse_size_);
    std::size_t slot = Mix(key) & mask;
    while (table_[slot].round == round_ && table_[slot].key != key) slot = (slot + 1) & mask;
    if (table_[slot].round == round_) continue;
    table_[slot] = {key, round_};
    output->push_back(point);
  }
}

}  // namespace trajlo
