// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/evaluation/association.h"
#include "core/evaluation/pose_errors.h"

namespace trajlo {

/// Absolute errors of pairs whose estimate has been aligned: E = estimate⁻¹ truth, translation
/// |t_estimate - t_truth|. Without orientation only translation_m is filled.
PoseErrors AbsoluteErrors(const std::vector<PosePair>& aligned, bool with_orientation);

}  // namespace trajlo
