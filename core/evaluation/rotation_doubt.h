// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/evaluation/alignment.h"
#include "core/evaluation/association.h"
#include "core/io/trajectory_file.h"

namespace trajlo {

/// What the absolute rotation errors are worth.
struct RotationDoubt {
  /// False: most of them is a turn of the whole estimate that the alignment leaves open.
  bool determined = true;
  /// What to know about them, a sentence each.
  std::vector<std::string> warnings;
};

/// An alignment by positions turns the attitudes along, about a line or a place as it happens to
/// come. So a constant turn of the attitudes within three of `Alignment::rotation_sigma_rad` says
/// nothing about them, and where it is the most of their error, nor does that.
/// A constant turn that the alignment does fix is one between the two frames on the body, or a
/// truth whose quaternions have w where `truth_format` does not. `aligned` needs orientation.
RotationDoubt JudgeRotations(const std::vector<PosePair>& aligned, const Alignment& alignment,
                             TrajectoryFormat truth_format);

}  // namespace trajlo
