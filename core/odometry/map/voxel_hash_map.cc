// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_hash_map.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

namespace trajlo {
namespace {

/// Points are inserted and checked in batches. Each of these goes in steps, which fetch ahead what
/// the next one reads.
constexpr std::size_t kBatch = 32;

/// From a voxel to those that share a face with it.
const VoxelKey kFaces[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

}  // namespace

/// The points of seven voxels, relative to the corner of the middle one.
struct VoxelHashMap::Candidates {
  /// The last block may hold less than its capacity.
  static constexpr int kMax = 7 * kMaxPointsPerVoxel + Block::kCapacity;
  int count = 0;
  float squared_distance[kMax], x[kMax], y[kMax], z[kMax];
  /// Where the point is: four times its block, and which of the block.
  std::uint32_t at[kMax];
};

VoxelHashMap::VoxelHashMap(double voxel_size_m, double min_point_spacing_m, double radius_m)
    : voxel_size_(voxel_size_m),
      inverse_size_(1.0 / voxel_size_m),
      spacing_(min_point_spacing_m),
      radius_(radius_m) {}

std::uint32_t VoxelHashMap::NewBlock(const VoxelKey& key) {
  auto block = static_cast<std::uint32_t>(blocks_.size());
  if (free_blocks_.empty()) {
    if (block == kNoNext) {
      throw std::length_error("the map holds more than 16 million blocks of four points");
    }
    blocks_.emplace_back();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
    blocks_[block] = Block();
  }
  blocks_[block].key = key;
  return block;
}

bool VoxelHashMap::HasRoomFor(std::uint32_t block, const Eigen::Vector3f& p) const {
  const auto squared_spacing = static_cast<float>(spacing_ * spacing_);
  std::uint32_t count = 0;
  for (std::uint32_t b = block; b < kNoNext; b = blocks_[b].next) {
    const Block& points = blocks_[b];
    bool is_near = false;
    for (std::uint32_t i = 0; i < Block::kCapacity; ++i) {
      const float x = points.x[i] - p.x(), y = points.y[i] - p.y(), z = points.z[i] - p.z();
      is_near |= (i < points.count) & (x * x + y * y + z * z < squared_spacing);
    }
    if (is_near) return false;
    count += points.count;
  }
  return count < kMaxPointsPerVoxel;
}

void VoxelHashMap::Append(VoxelIndex::Slot slot, const VoxelKey& key, const Eigen::Vector3f& p,
                          const SeenFrom& seen_from) {
  VoxelIndex::Entry& entry = index_[slot];
  if (entry.block == VoxelIndex::kNoBlock) entry.block = NewBlock(key);
  std::uint32_t last = entry.block;
  while (blocks_[last].next != kNoNext) last = blocks_[last].next;
  if (blocks_[last].count == Block::kCapacity) {
    const std::uint32_t next = NewBlock(key);
    blocks_[last].next = next;
    last = next;
  }
  Block& points = blocks_[last];
  points.x[points.count] = seen_from.PutInto(p.x(), 0);
  points.y[points.count] = seen_from.PutInto(p.y(), 1);
  points.z[points.count] = seen_from.PutInto(p.z(), 2);
  ++points.count;
  ++point_count_;
}

void VoxelHashMap::AddAround(VoxelIndex::Entry* entry) {
  ++entry->points_around;
  if (entry->points_around != kPointsOfSite) return;
  if (free_sites_.empty()) {
    if (site_count_ == VoxelIndex::kNoSite) {
      throw std::length_error("the map holds more than 16 million voxels");
    }
    entry->site = static_cast<std::uint32_t>(site_count_++);
  } else {
    entry->site = free_sites_.back();
    free_sites_.pop_back();
  }
}

std::vector<MapPoint> VoxelHashMap::Insert(const std::vector<MapPoint>& points) {
  std::vector<MapPoint> accepted;
  std::array<VoxelKey, kBatch> keys;
  std::array<std::array<VoxelIndex::Slot, 7>, kBatch> around;
  for (std::size_t first = 0; first < points.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      keys[i] = KeyOf(points[first + i].place_world);
      around[i][0] = index_.FindOrAdd(keys[i]);
      index_.Prefetch(around[i][0]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t block = index_[around[i][0]].block;
      if (block != VoxelIndex::kNoBlock) __builtin_prefetch(&blocks_[block]);
    }
    std::size_t placed = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const MapPoint& point = points[first + i];
      const Eigen::Vector3f p = (point.place_world - CornerOf(keys[i])).cast<float>();
      const VoxelIndex::Slot slot = around[i][0];
      if (!HasRoomFor(index_[slot].block, p)) continue;
      Append(slot, keys[i], p, SeenFrom(point.to_sensor_world));
      accepted.push_back(point);
      around[placed][0] = slot;
      for (std::size_t f = 0; f < 6; ++f) {
        around[placed][1 + f] = index_.FindOrAddBeside(keys[i], slot, keys[i] + kFaces[f]);
        index_.Prefetch(around[placed][1 + f]);
      }
      ++placed;
    }
    for (std::size_t i = 0; i < placed; ++i) {
      for (const VoxelIndex::Slot slot : around[i]) AddAround(&index_[slot]);
    }
  }
  return accepted;
}

void VoxelHashMap::DropRefused(std::vector<MapPoint>* all) const {
  std::array<VoxelKey, kBatch> keys;
  std::array<VoxelIndex::Slot, kBatch> slots;
  std::size_t kept = 0;
  for (std::size_t first = 0; first < all->size(); first += kBatch) {
    MapPoint* points = &(*all)[first];
    const std::size_t count = std::min(kBatch, all->size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      keys[i] = KeyOf(points[i].place_world);
      slots[i] = index_.Find(keys[i]);
      if (slots[i] != VoxelIndex::kNoSlot) index_.Prefetch(slots[i]);
    }
    std::array<std::uint32_t, kBatch> blocks;
    for (std::size_t i = 0; i < count; ++i) {
      blocks[i] = VoxelIndex::kNoBlock;
      if (slots[i] != VoxelIndex::kNoSlot) blocks[i] = index_[slots[i]].block;
      if (blocks[i] != VoxelIndex::kNoBlock) __builtin_prefetch(&blocks_[blocks[i]]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f p = (points[i].place_world - CornerOf(keys[i])).cast<float>();
      if (HasRoomFor(blocks[i], p)) (*all)[kept++] = points[i];
    }
  }
  all->resize(kept);
}

void VoxelHashMap::DropVoxel(const VoxelKey& key, std::vector<std::uint32_t>* changed) {
  std::uint32_t points = 0;
  VoxelIndex::Entry& dropped = index_[index_.FindOrAdd(key)];
  for (std::uint32_t b = dropped.block; b < kNoNext; b = blocks_[b].next) {
    points += blocks_[b].count;
    blocks_[b].count = 0;
    free_blocks_.push_back(b);
  }
  dropped.block = VoxelIndex::kNoBlock;
  point_count_ -= points;
  const auto release = [&](const VoxelKey& near) {
    VoxelIndex::Entry& entry = index_[index_.FindOrAdd(near)];
    entry.points_around -= points;
    if (entry.site != VoxelIndex::kNoSite) {
      changed->push_back(entry.site);
      if (entry.points_around < kPointsOfSite) {
        free_sites_.push_back(entry.site);
        entry.site = VoxelIndex::kNoSite;
      }
    }
    if (entry.points_around == 0) index_.Erase(near);
  };
  release(key);
  for (const VoxelKey& face : kFaces) release(key + face);
}

void VoxelHashMap::RemoveFar(const Eigen::Vector3d& center_world,
                             std::vector<std::uint32_t>* changed) {
  // Removal visits every voxel. Queries can only tell at the rim of the map that it is done from
  // time to time.
  const double slack = 0.05 * radius_;
  if (last_removal_center_ && (center_world - *last_removal_center_).norm() < slack) return;
  last_removal_center_ = center_world;
  for (const Block& block : blocks_) {
    if (block.count == 0) continue;
    const Eigen::Vector3d center =
        CornerOf(block.key) + Eigen::Vector3d::Constant(0.5 * voxel_size_);
    if ((center - center_world).norm() > radius_) DropVoxel(block.key, changed);
  }
}

void VoxelHashMap::Gather(std::uint32_t block, const Eigen::Vector3f& shift,
                          const Eigen::Vector3f& query, Candidates* candidates) const {
  for (; block < kNoNext; block = blocks_[block].next) {
    const Block& points = blocks_[block];
    const int first = candidates->count;
    // All lanes of the block; what is beyond its points is overwritten by the next one.
    for (int i = 0; i < Block::kCapacity; ++i) {
      const float x = points.x[i] + shift.x();
      const float y = points.y[i] + shift.y();
      const float z = points.z[i] + shift.z();
      const float dx = x - query.x(), dy = y - query.y(), dz = z - query.z();
      candidates->x[first + i] = x;
      candidates->y[first + i] = y;
      candidates->z[first + i] = z;
      candidates->at[first + i] = Block::kCapacity * block + static_cast<std::uint32_t>(i);
      candidates->squared_distance[first + i] = dx * dx + dy * dy + dz * dz;
    }
    candidates->count += static_cast<int>(points.count);
  }
}

void VoxelHashMap::Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const {
  neighbors->count = 0;
  const VoxelKey key = KeyOf(query_world);
  VoxelIndex::Slot around[7] = {index_.Find(key)};
  for (int i = 0; i < 6; ++i) {
    around[1 + i] = index_.FindBeside(key, around[0], key + kFaces[i]);
  }
  std::uint32_t blocks[7];
  for (int i = 0; i < 7; ++i) {
    blocks[i] = around[i] == VoxelIndex::kNoSlot ? VoxelIndex::kNoBlock : index_[around[i]].block;
    if (blocks[i] != VoxelIndex::kNoBlock) __builtin_prefetch(&blocks_[blocks[i]]);
  }

  const Eigen::Vector3d corner = CornerOf(key);
  const Eigen::Vector3f query = (query_world - corner).cast<float>();
  const auto size = static_cast<float>(voxel_size_);
  Candidates candidates;
  Gather(blocks[0], Eigen::Vector3f::Zero(), query, &candidates);
  for (int i = 0; i < 6; ++i) {
    Gather(blocks[1 + i], size * kFaces[i].cast<float>(), query, &candidates);
  }
  neighbors->origin_world = corner;
  TakeNearest(candidates, k, neighbors);
}

void VoxelHashMap::TakeNearest(const Candidates& candidates, int wanted,
                               Neighbors* neighbors) const {
  const int k = std::clamp(wanted, 1, kMaxNeighbors);
  // Sorted by insertion. The bits of a positive float are in the order of its value, and the index
  // below them decides between equals.
  std::uint64_t best[kMaxNeighbors];
  int count = 0;
  for (int c = 0; c < candidates.count; ++c) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &candidates.squared_distance[c], sizeof(bits));
    const std::uint64_t rank = std::uint64_t{bits} << 32 | static_cast<std::uint32_t>(c);
    if (count == k && rank >= best[k - 1]) continue;
    int i = count < k ? count++ : k - 1;
    for (; i > 0 && best[i - 1] > rank; --i) best[i] = best[i - 1];
    best[i] = rank;
  }
  neighbors->count = count;
  for (int i = 0; i < count; ++i) {
    const auto c = static_cast<std::uint32_t>(best[i]);
    neighbors->squared_distance[i] = candidates.squared_distance[c];
    neighbors->x[i] = candidates.x[c];
    neighbors->y[i] = candidates.y[c];
    neighbors->z[i] = candidates.z[c];
    const Block& block = blocks_[candidates.at[c] / Block::kCapacity];
    const std::uint32_t in_block = candidates.at[c] % Block::kCapacity;
    neighbors->seen_from[i] = SeenFrom::Of(block.x[in_block], block.y[in_block], block.z[in_block]);
  }
}

void VoxelHashMap::ForEachPoint(const std::function<void(const MapPoint&)>& visit) const {
  for (const Block& block : blocks_) {
    const Eigen::Vector3d corner = CornerOf(block.key);
    for (std::uint32_t i = 0; i < block.count; ++i) {
      const float x = block.x[i], y = block.y[i], z = block.z[i];
      visit({corner + Eigen::Vector3d(x, y, z), SeenFrom::Of(x, y, z).Direction()});
    }
  }
}

}  // namespace trajlo
