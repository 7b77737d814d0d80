// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/evaluation/association.h"
#include "core/evaluation/pose_errors.h"
#include "core/evaluation/relative_pairs.h"

namespace trajlo {

enum class DeltaUnit { kMetres, kSeconds, kFrames, kDegrees };

/// "m", "s", "f", "d".
const char* DeltaUnitName(DeltaUnit unit);

/// The pieces over which relative errors are computed.
struct RelativeErrorOptions {
  double delta = 1.0;
  DeltaUnit unit = DeltaUnit::kMetres;
  /// One piece from every pose instead of pieces in a row. Pieces of seconds always begin at every
  /// pose, pieces of degrees are always in a row.
  bool all_pairs = false;
  /// Metres and degrees are measured along the truth instead of the aligned estimate.
  bool along_truth = false;
  /// All pairs of metres or seconds: pieces whose length is off by more than this share are left
  /// out. Infinity accepts the nearest, as the TUM RGB-D benchmark does.
  double tolerance = 0.1;
};

/// The pieces of pairs whose estimate has been aligned; indices of `aligned`. `estimate_t_ns` are
/// all stamps of the estimate, also of poses without a partner: a piece of seconds whose end has
/// none is left out instead of being stretched. It may be empty if the unit is not seconds.
/// Pieces of seconds run from their end to their beginning, because the TUM RGB-D benchmark
/// measures the error of the beginning seen from the end; evo does the opposite (and has no
/// seconds). Rotations are the same, translations differ a little.
IndexPairs SelectPieces(const std::vector<PosePair>& aligned,
                        const std::vector<std::int64_t>& estimate_t_ns,
                        const RelativeErrorOptions& options);

/// E = (truth_i⁻¹ truth_j)⁻¹ (estimate_i⁻¹ estimate_j) for each piece. Without orientation only
/// point_distance_m is filled.
PoseErrors RelativeErrors(const std::vector<PosePair>& aligned, const IndexPairs& pieces,
                          bool with_orientation);

}  // namespace trajlo
