// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_hash_map.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace trajlo {
namespace {

/// From a voxel to those that share a face with it.
const VoxelKey kFaces[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

}  // namespace

/// The k best candidates so far, sorted by distance.
struct VoxelHashMap::Best {
  int k;
  Neighbors* out;

  float Worst() const {
    return out->count < k ? std::numeric_limits<float>::max() : out->squared_distance[k - 1];
  }

  void Offer(float squared_distance, float x, float y, float z) {
    int i = out->count < k ? out->count++ : k - 1;
    for (; i > 0 && out->squared_distance[i - 1] > squared_distance; --i) {
      out->squared_distance[i] = out->squared_distance[i - 1];
      out->x[i] = out->x[i - 1];
      out->y[i] = out->y[i - 1];
      out->z[i] = out->z[i - 1];
    }
    out->squared_distance[i] = squared_distance;
    out->x[i] = x;
    out->y[i] = y;
    out->z[i] = z;
  }
};

VoxelHashMap::VoxelHashMap(double voxel_size_m, double min_point_spacing_m, double radius_m,
                           int points_of_site)
    : voxel_size_(voxel_size_m),
      inverse_size_(1.0 / voxel_size_m),
      spacing_(min_point_spacing_m),
      radius_(radius_m),
      points_of_site_(static_cast<std::uint32_t>(points_of_site)) {}

std::uint32_t VoxelHashMap::NewBlock(const VoxelKey& key) {
  auto block = static_cast<std::uint32_t>(blocks_.size());
  if (free_blocks_.empty()) {
    if (block == kNoNext) throw std::length_error("the map holds more than 16 million voxels");
    blocks_.emplace_back();
  } else {
    block = free_blocks_.back();
    free_blocks_.pop_back();
    blocks_[block] = Block();
  }
  blocks_[block].key = key;
  return block;
}

VoxelHashMap::Block* VoxelHashMap::PlaceFor(VoxelIndex::Entry* entry, const VoxelKey& key,
                                            const Eigen::Vector3f& p) {
  const auto squared_spacing = static_cast<float>(spacing_ * spacing_);
  int count = 0;
  std::uint32_t last = VoxelIndex::kNoBlock;
  for (std::uint32_t b = entry->block; b < kNoNext; b = blocks_[b].next) {
    const Block& block = blocks_[b];
    for (std::uint32_t i = 0; i < block.count; ++i) {
      const Eigen::Vector3f q(block.x[i], block.y[i], block.z[i]);
      if ((p - q).squaredNorm() < squared_spacing) return nullptr;
    }
    count += static_cast<int>(block.count);
    last = b;
  }
  if (count >= kMaxPointsPerVoxel) return nullptr;
  if (last == VoxelIndex::kNoBlock) {
    entry->block = last = NewBlock(key);
  } else if (blocks_[last].count == Block::kCapacity) {
    const std::uint32_t next = NewBlock(key);
    blocks_[last].next = next;
    last = next;
  }
  return &blocks_[last];
}

void VoxelHashMap::AddAround(VoxelIndex::Entry* entry) {
  ++entry->points_around;
  if (entry->points_around != points_of_site_) return;
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

bool VoxelHashMap::InsertPoint(const VoxelKey& key, const Eigen::Vector3d& point_world) {
  index_.Reserve(7);
  const Eigen::Vector3f p = (point_world - CornerOf(key)).cast<float>();
  VoxelIndex::Entry* entry = index_.FindOrAdd(key);
  Block* block = PlaceFor(entry, key, p);
  if (block == nullptr) return false;
  block->x[block->count] = p.x();
  block->y[block->count] = p.y();
  block->z[block->count] = p.z();
  ++block->count;
  ++point_count_;
  AddAround(entry);
  for (const VoxelKey& face : kFaces) AddAround(index_.FindOrAdd(key + face));
  return true;
}

void VoxelHashMap::Insert(const std::vector<Eigen::Vector3d>& points_world,
                          std::vector<Eigen::Vector3d>* accepted) {
  constexpr std::size_t kBatch = 32;
  std::array<VoxelKey, kBatch> keys;
  for (std::size_t first = 0; first < points_world.size(); first += kBatch) {
    const std::size_t count = std::min(kBatch, points_world.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      keys[i] = KeyOf(points_world[first + i]);
      index_.Prefetch(keys[i]);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const VoxelIndex::Entry* entry = index_.Find(keys[i]);
      if (entry != nullptr && entry->block != VoxelIndex::kNoBlock) {
        __builtin_prefetch(&blocks_[entry->block]);
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& point = points_world[first + i];
      if (InsertPoint(keys[i], point) && accepted != nullptr) accepted->push_back(point);
    }
  }
}

void VoxelHashMap::DropVoxel(const VoxelKey& key, std::vector<std::uint32_t>* changed) {
  std::uint32_t points = 0;
  for (std::uint32_t b = index_.Find(key)->block; b < kNoNext; b = blocks_[b].next) {
    points += blocks_[b].count;
    blocks_[b].count = 0;
    free_blocks_.push_back(b);
  }
  index_.FindOrAdd(key)->block = VoxelIndex::kNoBlock;
  point_count_ -= points;
  const auto release = [&](const VoxelKey& near) {
    VoxelIndex::Entry* entry = index_.FindOrAdd(near);
    entry->points_around -= points;
    if (entry->site != VoxelIndex::kNoSite) {
      changed->push_back(entry->site);
      if (entry->points_around < points_of_site_) {
        free_sites_.push_back(entry->site);
        entry->site = VoxelIndex::kNoSite;
      }
    }
    if (entry->points_around == 0) index_.Erase(near);
  };
  release(key);
  for (const VoxelKey& face : kFaces) release(key + face);
}

void VoxelHashMap::RemoveFar(const Eigen::Vector3d& center_world,
                             std::vector<std::uint32_t>* changed) {
  // Removal visits every voxel; doing it only every so often changes nothing that queries can see
  // but the rim of the map.
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

void VoxelHashMap::Scan(std::uint32_t block, const Eigen::Vector3f& shift,
                        const Eigen::Vector3f& query, Best* best) const {
  // The query relative to this voxel's corner.
  const Eigen::Vector3f q = query - shift;
  for (; block < kNoNext; block = blocks_[block].next) {
    const Block& points = blocks_[block];
    float squared[Block::kCapacity];
    for (int i = 0; i < Block::kCapacity; ++i) {
      const float ex = points.x[i] - q.x(), ey = points.y[i] - q.y(), ez = points.z[i] - q.z();
      squared[i] = ex * ex + ey * ey + ez * ez;
    }
    for (std::uint32_t i = 0; i < points.count; ++i) {
      if (squared[i] >= best->Worst()) continue;
      best->Offer(squared[i], points.x[i] + shift.x(), points.y[i] + shift.y(),
                  points.z[i] + shift.z());
    }
  }
}

void VoxelHashMap::Nearest(const Eigen::Vector3d& query_world, int k, Neighbors* neighbors) const {
  neighbors->count = 0;
  const VoxelKey key = KeyOf(query_world);
  const Eigen::Vector3d corner = CornerOf(key);
  neighbors->origin_world = corner;
  const Eigen::Vector3f q = (query_world - corner).cast<float>();
  Best best{std::min(k, kMaxNeighbors), neighbors};

  const VoxelIndex::Entry* own = index_.Find(key);
  if (own == nullptr) return;
  Scan(own->block, Eigen::Vector3f::Zero(), q, &best);
  const auto size = static_cast<float>(voxel_size_);
  // The three nearer faces first: what is found there often spares the others.
  for (int i = 0; i < 6; ++i) {
    const int axis = i % 3;
    const bool upper = (q[axis] > 0.5F * size) == (i < 3);
    const float to_face = upper ? size - q[axis] : q[axis];
    if (to_face * to_face >= best.Worst()) continue;
    const VoxelKey& face = kFaces[2 * axis + (upper ? 1 : 0)];
    const VoxelIndex::Entry* entry = index_.Find(key + face);
    if (entry != nullptr) Scan(entry->block, size * face.cast<float>(), q, &best);
  }
}

void VoxelHashMap::ForEachPoint(const std::function<void(const Eigen::Vector3d&)>& visit) const {
  for (const Block& block : blocks_) {
    const Eigen::Vector3d corner = CornerOf(block.key);
    for (std::uint32_t i = 0; i < block.count; ++i) {
      visit(corner + Eigen::Vector3d(block.x[i], block.y[i], block.z[i]));
    }
  }
}

}  // namespace trajlo
