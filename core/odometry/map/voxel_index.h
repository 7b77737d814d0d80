// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/odometry/map/huge_page_allocator.h"
#include "manifolds/eigen_abi.h"

namespace trajlo {

/// The coordinates of a voxel: floor(p / size).
using VoxelKey = Eigen::Vector3i;

/// floor(p / size). A coordinate that has run away, or is NaN (for which no comparison holds), ends
/// as far from all sane ones as a packed key can be.
inline VoxelKey VoxelAt(const Eigen::Vector3d& p, double inverse_size) {
  constexpr double kLargest = (1 << 30) - (1 << 20);
  VoxelKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = std::floor(p[axis] * inverse_size);
    key[axis] = static_cast<int>(v > -kLargest ? (v < kLargest ? v : kLargest) : -kLargest);
  }
  return key;
}

/// What the map has at each voxel: bricks of 4 x 4 x 4 voxels, which a hash by open addressing
/// finds.
///
/// A surface runs through neighbouring voxels. So there are few bricks, the hash stays in the
/// innermost caches, and what is asked for a voxel and those around it lies close together: an
/// entry is eight bytes, and eight voxels that form a cube share a cache line.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNoBlock = ~std::uint32_t{0};
  static constexpr std::uint32_t kNoSite = (1U << 24) - 1;

  struct Entry {
    std::uint32_t block = kNoBlock;   ///< Where its points are.
    std::uint32_t site : 24;          ///< Its number, if planes are looked for there.
    std::uint32_t points_around : 8;  ///< Points of it and of the six that share a face.
    Entry() : site(kNoSite), points_around(0) {}
    bool IsEmpty() const { return block == kNoBlock && points_around == 0; }
  };
  static_assert(sizeof(Entry) == 8);

  /// Where an entry is. It stays there until it is erased.
  using Slot = std::uint32_t;
  static constexpr Slot kNoSlot = ~Slot{0};

  VoxelIndex() : table_(kSmallest) {}

  /// kNoSlot if nothing is known of the voxel. What is found may be empty, too.
  Slot Find(const VoxelKey& key) const {
    const std::uint32_t brick = FindBrick(BrickKey(key));
    return brick == kNoBrick ? kNoSlot : brick * kVoxels + Within(key);
  }
  /// The same, given the slot of `beside`, a voxel nearby: mostly in the same brick.
  Slot FindBeside(const VoxelKey& beside, Slot slot, const VoxelKey& key) const {
    const bool is_in_brick = slot != kNoSlot && BrickKey(beside) == BrickKey(key);
    return is_in_brick ? InBrickOf(slot, key) : Find(key);
  }
  /// A new entry is empty.
  Slot FindOrAdd(const VoxelKey& key);
  Slot FindOrAddBeside(const VoxelKey& beside, Slot slot, const VoxelKey& key) {
    return BrickKey(beside) == BrickKey(key) ? InBrickOf(slot, key) : FindOrAdd(key);
  }
  void Erase(const VoxelKey& key);

  Entry& operator[](Slot slot) { return bricks_[slot / kVoxels].entries[slot % kVoxels]; }
  const Entry& operator[](Slot slot) const {
    return bricks_[slot / kVoxels].entries[slot % kVoxels];
  }
  /// Brings an entry into the cache.
  void Prefetch(Slot slot) const { __builtin_prefetch(&(*this)[slot]); }

 private:
  static constexpr std::uint32_t kVoxels = 64;
  static constexpr std::uint32_t kNoBrick = kNoSlot / kVoxels;
  static constexpr std::uint64_t kNoKey = ~std::uint64_t{0};
  static constexpr std::size_t kSmallest = 1024;

  struct alignas(64) Brick {
    Entry entries[kVoxels];
  };
  struct Place {
    std::uint64_t key = kNoKey;
    std::uint32_t brick = kNoBrick;
  };

  /// 21 bits per axis: bricks that are a multiple of 2^21 apart are one, and no map is so wide.
  static std::uint64_t BrickKey(const VoxelKey& key) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
    return (static_cast<std::uint64_t>(key.x() >> 2) & kMask) |
           (static_cast<std::uint64_t>(key.y() >> 2) & kMask) << 21 |
           (static_cast<std::uint64_t>(key.z() >> 2) & kMask) << 42;
  }
  /// Which voxel of its brick: the bits of the coordinates interleaved.
  static std::uint32_t Within(const VoxelKey& key) {
    const auto x = static_cast<std::uint32_t>(key.x()), y = static_cast<std::uint32_t>(key.y()),
               z = static_cast<std::uint32_t>(key.z());
    return (x & 1) | (y & 1) << 1 | (z & 1) << 2 | (x & 2) << 2 | (y & 2) << 3 | (z & 2) << 4;
  }
  static Slot InBrickOf(Slot slot, const VoxelKey& key) {
    return slot / kVoxels * kVoxels + Within(key);
  }
  /// The finaliser of SplitMix64: neighbours land far apart.
  std::size_t Home(std::uint64_t key) const {
    std::uint64_t h = key;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    return (h ^ (h >> 31)) & (table_.size() - 1);
  }
  std::size_t Next(std::size_t i) const { return (i + 1) & (table_.size() - 1); }
  std::uint32_t FindBrick(std::uint64_t key) const {
    std::size_t i = Home(key);
    while (table_[i].key != key && table_[i].key != kNoKey) i = Next(i);
    return table_[i].brick;
  }
  std::uint32_t AddBrick(std::uint64_t key);
  void RemoveFromTable(std::uint64_t key);
  void Grow();

  std::vector<Brick, HugePageAllocator<Brick>> bricks_;
  std::vector<std::uint32_t> free_bricks_;
  std::vector<Place> table_;  ///< A power of two of them, at most half full.
  std::size_t size_ = 0;      ///< Bricks in the table.
};

}  // namespace trajlo
