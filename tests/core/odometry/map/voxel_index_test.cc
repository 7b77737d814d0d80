// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_index.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "tests/support/random_poses.h"

namespace trajlo {
namespace {

TEST(VoxelIndex, IsAMapFromVoxelsThroughAdditionsAndErasures) {
  // Few different keys, so that most are added and erased many times over.
  testing::Random random;
  VoxelIndex index;
  std::map<std::array<int, 3>, std::uint32_t> reference;
  const auto draw = [&] { return static_cast<int>(std::floor(random.Uniform(-9, 9))); };
  for (std::uint32_t i = 0; i < 200000; ++i) {
    const std::array<int, 3> k = {draw(), draw(), draw()};  // In this order.
    const VoxelKey key(k[0], k[1], k[2]);
    const VoxelIndex::Slot found = index.Find(key);
    const bool is_there = found != VoxelIndex::kNoSlot && !index[found].IsEmpty();
    ASSERT_EQ(is_there, reference.count(k) == 1);
    if (is_there) {
      ASSERT_EQ(index[found].block, reference.at(k));
    }
    const VoxelKey beside = key + VoxelKey::Unit(static_cast<int>(i % 3));
    const VoxelIndex::Slot near = index.Find(beside);
    ASSERT_EQ(index.FindBeside(beside, near, key), found);
    if (random.Uniform(0, 1) < 0.55) {
      const VoxelIndex::Slot slot = near != VoxelIndex::kNoSlot
                                        ? index.FindOrAddBeside(beside, near, key)
                                        : index.FindOrAdd(key);
      ASSERT_EQ(slot, index.Find(key));
      index[slot].block = i;
      reference[k] = i;
    } else {
      index.Erase(key);
      reference.erase(k);
    }
  }
  EXPECT_GT(reference.size(), 2000u);
  for (const auto& [k, block] : reference) index.Erase({k[0], k[1], k[2]});
  // A brick without entries leaves the table, with all of its voxels.
  for (const auto& [k, block] : reference) {
    ASSERT_EQ(index.Find({k[0], k[1], k[2]}), VoxelIndex::kNoSlot);
  }
}

TEST(VoxelIndex, AnEntryBeginsEmptyAndStaysWhereItIsWhenTheTableGrows) {
  VoxelIndex index;
  const VoxelIndex::Slot slot = index.FindOrAdd({1, 2, 3});
  EXPECT_TRUE(index[slot].IsEmpty());
  EXPECT_EQ(index[slot].site, VoxelIndex::kNoSite);
  index[slot].block = 5;
  index[slot].site = VoxelIndex::kNoSite - 1;
  index[slot].points_around = 140;
  for (int i = 0; i < 5000; ++i) index.FindOrAdd({4 * i, -i, 7});
  EXPECT_EQ(index.Find({1, 2, 3}), slot);
  EXPECT_EQ(index[slot].block, 5u);
  EXPECT_EQ(index[slot].site, VoxelIndex::kNoSite - 1);
  EXPECT_EQ(index[slot].points_around, 140u);
}

TEST(VoxelIndex, TakesAVoxelOfTheCoarserGridForEightOfTheFiner) {
  // The levels of the map count on it.
  testing::Random random(2);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d p = 1e4 * Eigen::Vector3d(random.Direction());
    const VoxelKey fine = VoxelAt(p, 1.0 / 0.15), coarse = VoxelAt(p, 1.0 / 0.6);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(fine[axis] >> 2, coarse[axis]);
  }
}

}  // namespace
}  // namespace trajlo
