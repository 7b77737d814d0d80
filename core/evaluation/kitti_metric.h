// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/evaluation/association.h"

namespace trajlo {

/// The lengths of the pieces, m.
constexpr std::array<double, 8> kKittiLengths_m = {100, 200, 300, 400, 500, 600, 700, 800};

/// One piece: from `first_frame` to the first frame that is more than `length_m` further on.
struct KittiSegment {
  std::size_t first_frame = 0;
  double length_m = 0.0;
  double translation_m_per_m = 0.0;
  double rotation_rad_per_m = 0.0;
};

/// Means over all segments of one length; `segments` may be 0, the means are 0 then.
struct KittiLength {
  double length_m = 0.0;
  std::size_t segments = 0;
  double translation_percent = 0.0;
  double rotation_deg_per_m = 0.0;
};

struct KittiErrors {
  std::vector<KittiSegment> segments;
  /// Plain means over all segments of all lengths; 0 if there is none.
  double translation_percent = 0.0;
  double rotation_deg_per_m = 0.0;
  std::vector<KittiLength> per_length;
};

/// Relative errors by the rules of the KITTI odometry development kit: pieces begin at every tenth
/// frame, path lengths are measured along the truth, E = (estimate_i⁻¹ estimate_j)⁻¹
/// (truth_i⁻¹ truth_j), errors are |t_E| / length and the angle of E / length. In double precision;
/// the kit's single precision changes averages by less than 2e-5 percent.
/// Frames are the pairs as they are; the frames of estimate and truth must agree, the worlds need
/// not.
KittiErrors ComputeKittiErrors(const std::vector<PosePair>& pairs);

}  // namespace trajlo
