// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_index.h"

#include <utility>

namespace trajlo {

VoxelIndex::Entry* VoxelIndex::FindOrAdd(const VoxelKey& key) {
  if (2 * (size_ + 1) > entries_.size()) Grow();
  const std::uint64_t packed = Pack(key);
  std::size_t i = Home(packed);
  for (; entries_[i].packed_key != kEmpty; i = Next(i)) {
    if (entries_[i].packed_key == packed) return &entries_[i];
  }
  entries_[i].packed_key = packed;
  ++size_;
  return &entries_[i];
}

void VoxelIndex::Erase(const VoxelKey& key) {
  const Entry* found = Find(key);
  if (found == nullptr) return;
  // What was pushed past the gap moves up, so that every search still ends at an empty entry.
  auto gap = static_cast<std::size_t>(found - entries_.data());
  for (std::size_t i = Next(gap); entries_[i].packed_key != kEmpty; i = Next(i)) {
    const std::size_t mask = entries_.size() - 1;
    const std::size_t home = Home(entries_[i].packed_key);
    if (((i - home) & mask) < ((i - gap) & mask)) continue;
    entries_[gap] = entries_[i];
    gap = i;
  }
  entries_[gap] = Entry();
  --size_;
}

void VoxelIndex::Grow() {
  std::vector<Entry> former(2 * entries_.size());
  former.swap(entries_);
  for (const Entry& entry : former) {
    if (entry.packed_key == kEmpty) continue;
    std::size_t i = Home(entry.packed_key);
    while (entries_[i].packed_key != kEmpty) i = Next(i);
    entries_[i] = entry;
  }
}

}  // namespace trajlo
