// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

#include "core/odometry/map/huge_page_allocator.h"
#include "core/odometry/map/plane_fit.h"

namespace trajlo {

/// The planes of a map, one for each eighth of a voxel that is a site, fitted when first asked for.
///
/// A plane is kept until the number of points around its site has grown by more than an eighth plus
/// one. It is a function of the place and of the map at the time of the fit, and the map does not
/// change while planes are asked for: so no answer depends on which thread came first. One of them
/// claims the cell; another that finds it claimed fits for itself.
class PlaneCells {
 public:
  /// For sites with numbers below `sites`. Not while another thread is in Get().
  void Resize(std::size_t sites) {
    constexpr std::size_t kSites = std::size_t{1} << kSitesPerBlockLog2;
    if (blocks_.empty()) blocks_.emplace_back();
    // A small map has a small block: clearing a whole one takes time, and the search for the first
    // motion makes many small maps.
    blocks_.front().resize(kPerSite * std::min(sites, kSites));
    while (blocks_.size() * kSites < sites) blocks_.emplace_back(kPerSite * kSites);
  }
  /// Forgets the planes of a site. Not while another thread is in Get().
  void Clear(std::uint32_t site) {
    for (std::uint32_t i = 0; i < kPerSite; ++i) {
      At(site, i).state.store(kNever, std::memory_order_relaxed);
    }
  }

  void Prefetch(std::uint32_t site, std::uint32_t cell) const {
    __builtin_prefetch(&At(site, cell));
  }

  /// The plane that is kept, or else that of `fit()`. `points_around` > 0.
  template <typename Fit>
  FittedPlane Get(std::uint32_t site, std::uint32_t cell, std::uint32_t points_around,
                  const Fit& fit) const {
    Cell& kept = At(site, cell);
    std::uint32_t state = kept.state.load(std::memory_order_acquire);
    if (IsKept(state >> 1, points_around)) return {kept.numbers, (state & kOneSided) != 0};
    const bool is_mine = state != kClaimed && kept.state.compare_exchange_strong(
                                                  state, kClaimed, std::memory_order_relaxed);
    FittedPlane plane = fit();
    if (is_mine) {
      kept.numbers = plane;
      kept.state.store(points_around << 1 | (plane.is_one_sided ? kOneSided : 0U),
                       std::memory_order_release);
    }
    return plane;
  }

 private:
  static constexpr std::uint32_t kPerSite = 8;
  static constexpr std::uint32_t kSitesPerBlockLog2 = 13;
  static constexpr std::uint32_t kNever = 0;
  static constexpr std::uint32_t kClaimed = ~std::uint32_t{0};
  static constexpr std::uint32_t kOneSided = 1;

  struct alignas(32) Cell {
    PlaneNumbers numbers;
    /// Twice the number of points around its site at the fit, and kOneSided.
    std::atomic<std::uint32_t> state{kNever};

    Cell() = default;
    Cell(const Cell& other)
        : numbers(other.numbers), state(other.state.load(std::memory_order_relaxed)) {}
  };

  static bool IsKept(std::uint32_t fitted_at, std::uint32_t points_around) {
    // A claimed one counts more points than there can be.
    return fitted_at > 0 && fitted_at <= points_around &&
           points_around - fitted_at <= fitted_at / 8 + 1;
  }

  Cell& At(std::uint32_t site, std::uint32_t cell) const {
    constexpr std::uint32_t kLast = (std::uint32_t{1} << kSitesPerBlockLog2) - 1;
    return blocks_[site >> kSitesPerBlockLog2][kPerSite * (site & kLast) + cell];
  }

  /// A block is a huge page; only the first one grows.
  mutable std::vector<std::vector<Cell, HugePageAllocator<Cell>>> blocks_;
};

}  // namespace trajlo
