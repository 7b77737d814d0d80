// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// The coordinates of a voxel: floor(p / size).
using VoxelKey = Eigen::Vector3i;

/// floor(p / size). What has run away, or is NaN, for which no comparison holds, ends as far from
/// all that is near as a packed key can be.
inline VoxelKey VoxelAt(const Eigen::Vector3d& p, double inverse_size) {
  constexpr double kLargest = (1 << 30) - (1 << 20);
  VoxelKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = std::floor(p[axis] * inverse_size);
    key[axis] = static_cast<int>(v > -kLargest ? (v < kLargest ? v : kLargest) : -kLargest);
  }
  return key;
}

/// What the map has at a voxel: a hash by open addressing.
///
/// Registration asks it thousands of times a window, at random: an entry is sixteen bytes, lies
/// within a cache line of the place where its hash says, and can be fetched ahead.
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNoBlock = ~std::uint32_t{0};
  static constexpr std::uint32_t kNoSite = (1U << 24) - 1;

  struct Entry {
    std::uint64_t packed_key = kEmpty;
    std::uint32_t block = kNoBlock;   ///< Where its points are.
    std::uint32_t site : 24;          ///< Its number, if planes are looked for there.
    std::uint32_t points_around : 8;  ///< Points of it and of the six that share a face.
    Entry() : site(kNoSite), points_around(0) {}
  };

  VoxelIndex() : entries_(kSmallest) {}

  /// Null if there is none.
  const Entry* Find(const VoxelKey& key) const {
    const std::uint64_t packed = Pack(key);
    for (std::size_t i = Home(packed);; i = Next(i)) {
      if (entries_[i].packed_key == packed) return &entries_[i];
      if (entries_[i].packed_key == kEmpty) return nullptr;
    }
  }
  /// Brings the place where the entry should be into the cache.
  void Prefetch(const VoxelKey& key) const { __builtin_prefetch(&entries_[Home(Pack(key))]); }

  /// A new entry is empty. Others may move.
  Entry* FindOrAdd(const VoxelKey& key);
  void Erase(const VoxelKey& key);
  std::size_t size() const { return size_; }

 private:
  static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
  static constexpr std::size_t kSmallest = 1024;

  /// 21 bits an axis: voxels that are a multiple of 2^21 apart share an entry, and no map is so
  /// wide.
  static std::uint64_t Pack(const VoxelKey& key) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
    return (static_cast<std::uint64_t>(key.x()) & kMask) |
           (static_cast<std::uint64_t>(key.y()) & kMask) << 21 |
           (static_cast<std::uint64_t>(key.z()) & kMask) << 42;
  }
  /// The finaliser of SplitMix64: neighbours land far apart.
  std::size_t Home(std::uint64_t packed) const {
    std::uint64_t h = packed;
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
    return (h ^ (h >> 31)) & (entries_.size() - 1);
  }
  std::size_t Next(std::size_t i) const { return (i + 1) & (entries_.size() - 1); }
  void Grow();

  std::vector<Entry> entries_;  ///< A power of two of them, at most half full.
  std::size_t size_ = 0;
};

}  // namespace trajlo
