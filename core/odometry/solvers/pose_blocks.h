// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "manifolds/se3.h"

namespace trajlo {

/// The control poses of a window as Ceres sees them: blocks of [qx qy qz qw tx ty tz].
class PoseBlocks {
 public:
  explicit PoseBlocks(std::size_t count) : blocks_(count) {}

  double* block(int k) { return blocks_[static_cast<std::size_t>(k)].data(); }
  std::size_t size() const { return blocks_.size(); }

  std::vector<SE3> Poses() const {
    std::vector<SE3> poses;
    poses.reserve(blocks_.size());
    for (const auto& block : blocks_) poses.push_back(SE3::FromData(block.data()));
    return poses;
  }
  void SetPoses(const std::vector<SE3>& poses) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      std::copy_n(poses[i].data(), 7, blocks_[i].data());
    }
  }

 private:
  std::vector<std::array<double, 7>> blocks_;
};

}  // namespace trajlo
