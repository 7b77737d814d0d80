// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// Indices of the first and the last pose of the pieces that relative errors are computed over.
using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Frames 0, d, 2d, ... in a row, or with `all` every i with i + d.
IndexPairs PairsOverFrames(std::size_t frames, std::size_t delta, bool all);

/// Pieces in a row, from index 0, each ending where the path reaches delta. This is how evo has
/// done it since 1.37.1; before, it left out the first piece.
IndexPairs ConsecutivePairsOverDistance(const std::vector<Eigen::Affine3d>& poses, double delta_m);

/// For every i the j > i at the path length nearest to delta, if it is within `tolerance` * delta.
IndexPairs AllPairsOverDistance(const std::vector<Eigen::Affine3d>& poses, double delta_m,
                                double tolerance);

/// Pieces in a row, from index 0, each ending where the accumulated rotation reaches delta.
IndexPairs ConsecutivePairsOverAngle(const std::vector<Eigen::Affine3d>& poses, double delta_deg);

/// For every i the j > i with the stamp nearest to that of i plus delta, if it is within
/// `tolerance` * delta. The last pose never ends a piece: it would be the nearest one for all that
/// begin late. With an infinite tolerance these are the pairs of the TUM RGB-D benchmark.
IndexPairs AllPairsOverTime(const std::vector<std::int64_t>& t_ns, double delta_s,
                            double tolerance);

}  // namespace trajlo
