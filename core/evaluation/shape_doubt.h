// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/evaluation/association.h"

namespace trajlo {

/// Whether the two trajectories have the same shape in another unit of length, or are mirror
/// images: a sentence for each; nothing where positions do not tell. `with_scale`: the scale is
/// aligned, and so no matter. `pairs` are those before the alignment, or after it.
std::vector<std::string> JudgeShape(const std::vector<PosePair>& pairs, bool with_scale);

}  // namespace trajlo
