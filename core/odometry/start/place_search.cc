// SPDX-License-Identifier: MIT
#include "core/odometry/start/place_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/odometry/segments/choose_evenly.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

using Cell = Eigen::Vector3i;

/// The edge of a cell as a share of the sweep's median range, and its bounds: cells, and steps of a
/// cell's width at that range, show the scene as coarsely in an office as in a street.
constexpr double kCellShare = 1.0 / 20.0;
constexpr double kMinCell_m = 0.25;
constexpr double kMaxCell_m = 1.0;
/// Points beyond this many median ranges are left out: a step of rotation moves them too far.
constexpr double kMaxRangeInMedians = 2.0;
constexpr std::size_t kMaxSweepPoints = 300;
/// Blocks of positions are 2^kTopLevel cells wide at first.
constexpr int kTopLevel = 3;
/// Of a cube of edge 1: sqrt(3) / 2.
constexpr double kHalfDiagonal = 0.87;
/// On each level, blocks are dropped if their bound is below the best one by more than this share
/// of the points, and those beyond this many.
constexpr double kHopeless = 0.3;
constexpr std::size_t kMaxBlocks = 30000;
/// Places nearer to each other than this are one.
constexpr double kSameInCells = 2.5;

/// Which cells are occupied. Bit L of a cell says whether any of the cells from it to 2^L cells on
/// is, along each axis: what a point can hit if it is moved by 0 to 2^L cells.
class Occupancy {
 public:
  Occupancy(const VoxelHashMap& map, const Eigen::Vector3d& center, double reach_m, double cell_m)
      : cell_m_(cell_m) {
    std::vector<Cell> occupied;
    map.ForEachPoint([&](const MapPoint& point) {
      const Eigen::Vector3d& p = point.place_world;
      if ((p - center).norm() > reach_m) return;
      occupied.emplace_back((p / cell_m_).array().floor().cast<int>());
    });
    if (occupied.empty()) return;
    Cell high = occupied.front();
    low_ = high;
    for (const Cell& cell : occupied) {
      low_ = low_.cwiseMin(cell);
      high = high.cwiseMax(cell);
    }
    low_.array() -= 1 << kTopLevel;
    size_ = high - low_ + Cell::Ones();
    bits_.assign(Index(size_ - Cell::Ones()) + 1, 0);
    for (const Cell& cell : occupied) bits_[Index(cell - low_)] = 1U << kOccupied;
    // From [i, i] to [i, i + 1], and on to [i, i + 2^L].
    Spread(kOccupied, 0, 1);
    for (int level = 0; level < kTopLevel; ++level) Spread(level, level + 1, 1 << level);
  }

  bool is_empty() const { return bits_.empty(); }

  /// How many of the cells, each moved by `offset`, have the bit of that level. The innermost loop
  /// of a search: on plain numbers, a negative one being a large one.
  int Count(const std::vector<Cell>& cells, const Cell& offset, int level) const {
    const int* cell = cells.data()->data();
    const int* const end = cell + 3 * cells.size();
    const Cell from = offset - low_;
    const int dx = from.x(), dy = from.y(), dz = from.z();
    const auto width = static_cast<unsigned>(size_.x()), depth = static_cast<unsigned>(size_.y()),
               height = static_cast<unsigned>(size_.z());
    const std::uint8_t* const bits = bits_.data();
    unsigned count = 0;
    for (; cell != end; cell += 3) {
      const auto x = static_cast<unsigned>(cell[0] + dx), y = static_cast<unsigned>(cell[1] + dy),
                 z = static_cast<unsigned>(cell[2] + dz);
      if (x >= width || y >= depth || z >= height) continue;
      count += bits[x + std::size_t{width} * (y + std::size_t{depth} * z)] >> level & 1U;
    }
    return static_cast<int>(count);
  }

 private:
  static constexpr int kOccupied = 7;

  std::size_t Index(const Cell& at) const {
    return static_cast<std::size_t>(at.x() + std::int64_t{size_.x()} *
                                                 (at.y() + std::int64_t{size_.y()} * at.z()));
  }

  /// Bit `to` of a cell becomes bit `from` of it or of any that is `step` farther along some axes.
  void Spread(int from, int to, int step) {
    for (std::uint8_t& bits : bits_) {
      bits = static_cast<std::uint8_t>(bits | (bits >> from & 1U) << to);
    }
    const auto mask = static_cast<std::uint8_t>(1U << to);
    std::size_t stride = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t ahead = stride * static_cast<std::size_t>(step);
      const std::size_t row = stride * static_cast<std::size_t>(size_[axis]);
      for (std::size_t begin = 0; begin < bits_.size(); begin += row) {
        // Cells ahead have not been changed yet.
        for (std::size_t i = begin; i + ahead < begin + row; ++i) {
          bits_[i] = static_cast<std::uint8_t>(bits_[i] | (bits_[i + ahead] & mask));
        }
      }
      stride = row;
    }
  }

  double cell_m_;
  Cell low_ = Cell::Zero();
  Cell size_ = Cell::Zero();
  std::vector<std::uint8_t> bits_;
};

/// Positions corner .. corner + 2^level cells, with one attitude.
struct Block {
  Cell corner;
  std::size_t turned;  ///< Which of the turned sweeps.
  int hits;            ///< Of the points, at most.
};

/// The sweep in one attitude: the cells of its points as seen from a position at a cell's corner.
struct TurnedSweep {
  Eigen::Quaterniond q_world_body;
  std::vector<Cell> cells;
};

double MedianRange(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> ranges;
  ranges.reserve(points.size());
  for (const Eigen::Vector3d& p : points) ranges.push_back(p.norm());
  return UpperMedian(std::move(ranges));
}

std::vector<Eigen::Vector3d> ChoosePoints(const std::vector<Eigen::Vector3d>& sweep,
                                          double max_range_m) {
  std::vector<Eigen::Vector3d> near;
  for (const Eigen::Vector3d& p : sweep) {
    if (p.norm() <= max_range_m) near.push_back(p);
  }
  return ChooseEvenly(near, kMaxSweepPoints);
}

class PlaceSearch {
 public:
  PlaceSearch(const std::vector<Eigen::Vector3d>& sweep, const VoxelHashMap& map,
              const SearchRegion& region, ThreadPool* threads)
      : region_(region),
        threads_(threads),
        median_range_m_(MedianRange(sweep)),
        cell_m_(std::clamp(kCellShare * median_range_m_, kMinCell_m, kMaxCell_m)),
        points_(ChoosePoints(sweep, kMaxRangeInMedians * median_range_m_)),
        occupancy_(map, region.center_world, region.radius_m + kMaxRangeInMedians * median_range_m_,
                   cell_m_) {
    Turn();
  }

  std::vector<SE3> Find(std::size_t count) {
    if (occupancy_.is_empty() || points_.empty()) return {};
    std::vector<Block> blocks = TopBlocks();
    for (int level = kTopLevel;; --level) {
      Keep(level, &blocks);
      if (level == 0) break;
      blocks = Halve(blocks, level);
    }
    return Distinct(blocks, count);
  }

 private:
  void Turn() {
    const double step_rad = cell_m_ / std::max(median_range_m_, cell_m_);
    const int steps = static_cast<int>(std::ceil(region_.max_turn_rad / step_rad));
    for (const Eigen::Quaterniond& q : region_.q_world_body) {
      for (int i = -steps; i <= steps; ++i) {
        const double turn_rad = region_.mean_turn_rad + i * step_rad;
        TurnedSweep turned = {
            Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, region_.turn_axis_world)) * q, {}};
        for (const Eigen::Vector3d& p : points_) {
          turned.cells.emplace_back(
              (turned.q_world_body * p / cell_m_).array().floor().cast<int>());
        }
        turned_.push_back(std::move(turned));
      }
    }
  }

  std::vector<Block> TopBlocks() const {
    const int width = 1 << kTopLevel;
    const int reach = static_cast<int>(std::ceil(region_.radius_m / (width * cell_m_)));
    const Cell center = (region_.center_world / cell_m_).array().round().cast<int>();
    std::vector<Block> blocks;
    for (int z = -reach; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const Cell corner = center + width * Cell(x, y, z) - Cell::Constant(width / 2);
          const double distance_m = Cell(x, y, z).cast<double>().norm() * width * cell_m_;
          if (distance_m > region_.radius_m + kHalfDiagonal * width * cell_m_) continue;
          for (std::size_t turned = 0; turned < turned_.size(); ++turned) {
            blocks.push_back({corner, turned, 0});
          }
        }
      }
    }
    return blocks;
  }

  /// Scores the blocks and keeps the hopeful ones, best first.
  void Keep(int level, std::vector<Block>* blocks) {
    constexpr std::size_t kChunk = 256;
    threads_->ParallelFor((blocks->size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
      const std::size_t last = std::min(blocks->size(), (chunk + 1) * kChunk);
      for (std::size_t i = chunk * kChunk; i < last; ++i) {
        Block& block = (*blocks)[i];
        block.hits = occupancy_.Count(turned_[block.turned].cells, block.corner, level);
      }
    });
    std::stable_sort(blocks->begin(), blocks->end(),
                     [](const Block& a, const Block& b) { return a.hits > b.hits; });
    const double least = blocks->front().hits - kHopeless * static_cast<double>(points_.size());
    const auto end = std::find_if(blocks->begin(), blocks->end(),
                                  [&](const Block& block) { return block.hits < least; });
    blocks->erase(end, blocks->end());
    if (blocks->size() > kMaxBlocks) blocks->resize(kMaxBlocks);
  }

  static std::vector<Block> Halve(const std::vector<Block>& blocks, int level) {
    const int half = 1 << (level - 1);
    std::vector<Block> halves;
    halves.reserve(8 * blocks.size());
    for (const Block& block : blocks) {
      for (int i = 0; i < 8; ++i) {
        const Cell corner = block.corner + half * Cell(i & 1, i >> 1 & 1, i >> 2 & 1);
        halves.push_back({corner, block.turned, 0});
      }
    }
    return halves;
  }

  std::vector<SE3> Distinct(const std::vector<Block>& blocks, std::size_t count) const {
    const double same_m = kSameInCells * cell_m_;
    const double same_rad = same_m / std::max(median_range_m_, cell_m_);
    std::vector<SE3> places;
    for (const Block& block : blocks) {
      if (places.size() == count) break;
      const Eigen::Vector3d t = cell_m_ * (block.corner.cast<double>().array() + 0.5);
      const SE3 place(turned_[block.turned].q_world_body, t);
      const bool is_new = std::none_of(places.begin(), places.end(), [&](const SE3& other) {
        return (other.t - t).norm() < same_m && other.q.angularDistance(place.q) < same_rad;
      });
      if (is_new) places.push_back(place);
    }
    return places;
  }

  const SearchRegion& region_;
  ThreadPool* threads_;
  double median_range_m_, cell_m_;
  std::vector<Eigen::Vector3d> points_;
  Occupancy occupancy_;
  std::vector<TurnedSweep> turned_;
};

}  // namespace

std::vector<SE3> FindPlaces(const std::vector<Eigen::Vector3d>& sweep_body, const VoxelHashMap& map,
                            const SearchRegion& region, std::size_t count, ThreadPool* threads) {
  if (sweep_body.empty()) return {};
  return PlaceSearch(sweep_body, map, region, threads).Find(count);
}

}  // namespace trajlo
