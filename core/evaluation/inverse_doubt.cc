// SPDX-License-Identifier: MIT
#include "core/evaluation/inverse_doubt.h"

#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/pose_errors.h"
#include "core/evaluation/shape_fit.h"
#include "core/io/format_text.h"

namespace trajlo {

std::string JudgeInverse(const std::vector<PosePair>& pairs, bool with_scale) {
  std::vector<PosePair> inverted = pairs;
  for (PosePair& pair : inverted) pair.truth = RigidInverse(pair.truth);
  try {
    const double rmse_m = FitShape(pairs, with_scale).rmse_m;
    const double inverted_m = FitShape(inverted, with_scale).rmse_m;
    // Of a body that circles a point, facing it, the inverse rests: anything that rests fits that.
    const bool has_shape = kFarBetter * inverted_m < SpreadOfTruth(inverted);
    if (!has_shape || rmse_m <= kSeen_m || kFarBetter * inverted_m >= rmse_m) return "";
    return FormatText(
        "the ground truth fits far better with its poses inverted (%.3g m in place of %.3g m): it "
        "seems to hold poses of the world in the body; those of the body in the world are needed",
        inverted_m, rmse_m);
  } catch (const EvaluationError&) {
    return "";  // A line or a place has no shape.
  }
}

}  // namespace trajlo
