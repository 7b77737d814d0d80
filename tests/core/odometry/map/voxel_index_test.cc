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
    const VoxelKey key(draw(), draw(), draw());
    const std::array<int, 3> k = {key.x(), key.y(), key.z()};
    const VoxelIndex::Entry* found = index.Find(key);
    ASSERT_EQ(found != nullptr, reference.count(k) == 1);
    if (found != nullptr) {
      ASSERT_EQ(found->block, reference.at(k));
    }
    if (random.Uniform(0, 1) < 0.55) {
      index.FindOrAdd(key)->block = i;
      reference[k] = i;
    } else {
      index.Erase(key);
      reference.erase(k);
    }
    ASSERT_EQ(index.size(), reference.size());
  }
  EXPECT_GT(reference.size(), 2000u);
}

TEST(VoxelIndex, AnEntryBeginsEmptyAndKeepsWhatItHoldsWhenTheTableGrows) {
  VoxelIndex index;
  VoxelIndex::Entry* entry = index.FindOrAdd({1, 2, 3});
  EXPECT_EQ(entry->block, VoxelIndex::kNoBlock);
  EXPECT_EQ(entry->site, VoxelIndex::kNoSite);
  EXPECT_EQ(entry->points_around, 0u);
  entry->block = 5;
  entry->site = VoxelIndex::kNoSite - 1;
  entry->points_around = 140;
  for (int i = 0; i < 5000; ++i) index.FindOrAdd({i, -i, 7});
  const VoxelIndex::Entry* same = index.Find({1, 2, 3});
  ASSERT_NE(same, nullptr);
  EXPECT_EQ(same->block, 5u);
  EXPECT_EQ(same->site, VoxelIndex::kNoSite - 1);
  EXPECT_EQ(same->points_around, 140u);
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
