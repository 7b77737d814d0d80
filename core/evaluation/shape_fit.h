// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/evaluation/association.h"

namespace trajlo {

/// Another reading of the truth (its unit, axes, or direction) is meant if positions agree better
/// by this.
constexpr double kFarBetter = 4.0;
/// Less is rounding: a flat path and its mirror image fit alike.
constexpr double kSeen_m = 1e-3;

/// How well positions agree once they are aligned.
struct ShapeFit {
  double rmse_m = 0.0;
  double scale = 1.0;
};

/// Throws EvaluationError where positions leave the alignment open.
ShapeFit FitShape(const std::vector<PosePair>& pairs, bool with_scale);

/// Of the true positions about their mean, RMS in m.
double SpreadOfTruth(const std::vector<PosePair>& pairs);

}  // namespace trajlo
