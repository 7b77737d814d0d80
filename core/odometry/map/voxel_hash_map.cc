// SPDX-License-Identifier: MIT
#include "core/odometry/map/voxel_hash_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trajlo {
namespace {

/// The voxels that share a face; the opposite of direction d is d ^ 1.
const Eigen::Vector3i kDirections[6] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                        {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

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

std::size_t VoxelHashMap::KeyHash::operator()(const Key& key) const {
  // Three odd multipliers, then SplitMix64's finaliser: neighbours land far apart.
  std::uint64_t h = static_cast<std::uint32_t>(key.x()) * 0x9E3779B97F4A7C15ULL ^
                    static_cast<std::uint32_t>(key.y()) * 0xC2B2AE3D27D4EB4FULL ^
                    static_cast<std::uint32_t>(key.z()) * 0x165667B19E3779F9ULL;
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ULL;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
  return h ^ (h >> 31);
}

VoxelHashMap::VoxelHashMap(const MapOptions& options)
    : options_(options),
      voxel_size_(options.voxel_size_m),
      stride_(3 * static_cast<std::size_t>(options.max_points_per_voxel)),
      counts_(1024, 0) {}

VoxelHashMap::Key VoxelHashMap::KeyOf(const Eigen::Vector3d& p) const {
  return (p / voxel_size_).array().floor().cast<int>();
}

int VoxelHashMap::Find(const Key& key) const {
  const auto found = index_.find(key);
  return found == index_.end() ? -1 : found->second;
}

void VoxelHashMap::AddToCounts(const Key& key, std::uint32_t points) {
  counts_[SlotOf(key)] += points;
  for (const Eigen::Vector3i& direction : kDirections) counts_[SlotOf(key + direction)] += points;
}

void VoxelHashMap::GrowCounts() {
  counts_.assign(4 * counts_.size(), 0);
  for (const Block& block : blocks_) {
    if (block.count > 0) AddToCounts(block.key, static_cast<std::uint32_t>(block.count));
  }
}

int VoxelHashMap::AddBlock(const Key& key) {
  int block = static_cast<int>(blocks_.size());
  if (free_.empty()) {
    blocks_.emplace_back();
    coordinates_.resize(coordinates_.size() + stride_);
  } else {
    block = free_.back();
    free_.pop_back();
  }
  index_[key] = block;
  // Seven entries a voxel: about every second one stays zero.
  if (10 * index_.size() > counts_.size()) GrowCounts();
  blocks_[block].key = key;
  blocks_[block].count = 0;
  for (int d = 0; d < 6; ++d) {
    const int neighbor = Find(key + kDirections[d]);
    blocks_[block].neighbors[d] = neighbor;
    if (neighbor >= 0) blocks_[neighbor].neighbors[d ^ 1] = block;
  }
  return block;
}

void VoxelHashMap::FreeBlock(int block) {
  for (int d = 0; d < 6; ++d) {
    const int neighbor = blocks_[block].neighbors[d];
    if (neighbor >= 0) blocks_[neighbor].neighbors[d ^ 1] = -1;
  }
  index_.erase(blocks_[block].key);
  AddToCounts(blocks_[block].key, -static_cast<std::uint32_t>(blocks_[block].count));
  point_count_ -= static_cast<std::size_t>(blocks_[block].count);
  blocks_[block].count = -1;
  free_.push_back(block);
}

bool VoxelHashMap::InsertPoint(const Eigen::Vector3d& point_world) {
  const Key key = KeyOf(point_world);
  int block = Find(key);
  if (block < 0) block = AddBlock(key);
  const int capacity = options_.max_points_per_voxel;
  const int count = blocks_[block].count;
  if (count >= capacity) return false;
  const Eigen::Vector3f p = (point_world - Corner(key)).cast<float>();
  float* points = coordinates_.data() + stride_ * block;
  const auto spacing = static_cast<float>(options_.min_point_spacing_m);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f q(points[i], points[capacity + i], points[2 * capacity + i]);
    if ((p - q).squaredNorm() < spacing * spacing) return false;
  }
  points[count] = p.x();
  points[capacity + count] = p.y();
  points[2 * capacity + count] = p.z();
  ++blocks_[block].count;
  AddToCounts(key, 1);
  ++point_count_;
  return true;
}

void VoxelHashMap::Insert(const std::vector<Eigen::Vector3d>& points_world,
                          std::vector<Eigen::Vector3d>* accepted) {
  for (const Eigen::Vector3d& point : points_world) {
    if (InsertPoint(point) && accepted != nullptr) accepted->push_back(point);
  }
}

void VoxelHashMap::RemoveFar(const Eigen::Vector3d& center_world) {
  // Removal visits every voxel; doing it only every so often changes nothing that queries can see
  // but the rim of the map.
  const double slack = 0.05 * options_.radius_m;
  if (last_removal_center_ && (center_world - *last_removal_center_).norm() < slack) return;
  last_removal_center_ = center_world;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (blocks_[block].count < 0) continue;
    const Eigen::Vector3d center =
        Corner(blocks_[block].key) + Eigen::Vector3d::Constant(0.5 * voxel_size_);
    if ((center - center_world).norm() > options_.radius_m) FreeBlock(static_cast<int>(block));
  }
}

void VoxelHashMap::Scan(int block, float dx, float dy, float dz, const float* query,
                        Best* best) const {
  const int capacity = options_.max_points_per_voxel;
  const int count = blocks_[block].count;
  const float* x = Points(block);
  const float* y = x + capacity;
  const float* z = y + capacity;
  // The query relative to this voxel's corner.
  const float qx = query[0] - dx, qy = query[1] - dy, qz = query[2] - dz;
  constexpr int kBatch = 32;
  float squared[kBatch];
  for (int first = 0; first < count; first += kBatch) {
    const int n = std::min(kBatch, count - first);
    for (int i = 0; i < n; ++i) {
      const float ex = x[first + i] - qx, ey = y[first + i] - qy, ez = z[first + i] - qz;
      squared[i] = ex * ex + ey * ey + ez * ez;
    }
    float worst = best->Worst();
    for (int i = 0; i < n; ++i) {
      if (squared[i] >= worst) continue;
      best->Offer(squared[i], x[first + i] + dx, y[first + i] + dy, z[first + i] + dz);
      worst = best->Worst();
    }
  }
}

void VoxelHashMap::Nearest(const Eigen::Vector3d& query_world, int k, int at_least,
                           Neighbors* neighbors) const {
  neighbors->count = 0;
  const Key key = KeyOf(query_world);
  const Eigen::Vector3d corner = Corner(key);
  neighbors->origin_world = corner;
  const Eigen::Vector3f q = (query_world - corner).cast<float>();
  Best best{std::min(k, kMaxNeighbors), neighbors};

  // Most queries in sparse surroundings end here: too few points for any answer that is wanted.
  if (counts_[SlotOf(key)] < static_cast<std::uint32_t>(at_least)) return;
  const int own = Find(key);
  int around[6];
  int count = own >= 0 ? blocks_[own].count : 0;
  for (int d = 0; d < 6; ++d) {
    around[d] = own >= 0 ? blocks_[own].neighbors[d] : Find(key + kDirections[d]);
    if (around[d] >= 0) count += blocks_[around[d]].count;
  }
  if (count < at_least) return;

  if (own >= 0) Scan(own, 0.0F, 0.0F, 0.0F, q.data(), &best);
  const auto size = static_cast<float>(voxel_size_);
  // The three nearer faces first: what is found there often spares the others.
  for (int i = 0; i < 6; ++i) {
    const int axis = i % 3;
    const bool upper = (q[axis] > 0.5F * size) == (i < 3);
    const int d = 2 * axis + (upper ? 1 : 0);
    if (around[d] < 0) continue;
    const float to_face = upper ? size - q[axis] : q[axis];
    if (to_face * to_face >= best.Worst()) continue;
    const Eigen::Vector3f shift = size * kDirections[d].cast<float>();
    Scan(around[d], shift.x(), shift.y(), shift.z(), q.data(), &best);
  }
}

void VoxelHashMap::ForEachPoint(const std::function<void(const Eigen::Vector3d&)>& visit) const {
  const int capacity = options_.max_points_per_voxel;
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    const Eigen::Vector3d corner = Corner(blocks_[block].key);
    const float* p = Points(static_cast<int>(block));
    for (int i = 0; i < blocks_[block].count; ++i) {
      visit(corner + Eigen::Vector3d(p[i], p[capacity + i], p[2 * capacity + i]));
    }
  }
}

}  // namespace trajlo
