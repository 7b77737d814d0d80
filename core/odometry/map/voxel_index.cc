// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_index.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace trajlo {

VoxelIndex::Slot VoxelIndex::FindOrAdd(const VoxelKey& key) {
  const std::uint64_t brick_key = BrickKey(key);
  std::uint32_t brick = FindBrick(brick_key);
  if (brick == kNoBrick) brick = AddBrick(brick_key);
  return brick * kVoxels + Within(key);
}

std::uint32_t VoxelIndex::AddBrick(std::uint64_t key) {
  if (2 * (size_ + 1) > table_.size()) Grow();
  auto brick = static_cast<std::uint32_t>(bricks_.size());
  if (free_bricks_.empty()) {
    if (brick == kNoBrick) throw std::length_error("the map is too large");
    bricks_.emplace_back();
  } else {
    brick = free_bricks_.back();
    free_bricks_.pop_back();
  }
  std::size_t i = Home(key);
  while (table_[i].key != kNoKey) i = Next(i);
  table_[i] = {key, brick};
  ++size_;
  return brick;
}

void VoxelIndex::Erase(const VoxelKey& key) {
  const Slot slot = Find(key);
  if (slot == kNoSlot) return;
  (*this)[slot] = Entry();
  const Brick& brick = bricks_[slot / kVoxels];
  if (!std::all_of(std::begin(brick.entries), std::end(brick.entries),
                   [](const Entry& entry) { return entry.IsEmpty(); })) {
    return;
  }
  RemoveFromTable(BrickKey(key));
  free_bricks_.push_back(slot / kVoxels);
}

void VoxelIndex::RemoveFromTable(std::uint64_t key) {
  std::size_t gap = Home(key);
  while (table_[gap].key != key) gap = Next(gap);
  // What was pushed past the gap moves up, so that every search still ends at an empty place.
  for (std::size_t i = Next(gap); table_[i].key != kNoKey; i = Next(i)) {
    const std::size_t mask = table_.size() - 1;
    const std::size_t home = Home(table_[i].key);
    if (((i - home) & mask) < ((i - gap) & mask)) continue;
    table_[gap] = table_[i];
    gap = i;
  }
  table_[gap] = Place();
  --size_;
}

void VoxelIndex::Grow() {
  std::vector<Place> former(2 * table_.size());
  former.swap(table_);
  for (const Place& place : former) {
    if (place.key == kNoKey) continue;
    std::size_t i = Home(place.key);
    while (table_[i].key != kNoKey) i = Next(i);
    table_[i] = place;
  }
}

}  // namespace trajlo
