// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/evaluation/association.h"

namespace trajlo {

/// A warning if the truth seems to hold poses of the world in the body, as an extrinsic calibration
/// or a camera's view matrix does: with its poses inverted, positions agree far better. Else empty.
/// `with_scale`: the scale is aligned. The truth needs orientation.
std::string JudgeInverse(const std::vector<PosePair>& pairs, bool with_scale);

}  // namespace trajlo
