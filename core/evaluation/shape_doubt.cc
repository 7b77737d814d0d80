// SPDX-License-Identifier: MIT
#include "core/evaluation/shape_doubt.h"

#include "core/evaluation/evaluation_error.h"
#include "core/evaluation/shape_fit.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

// An estimate may have a scale that is a little off; no unit of length is so near to another.
constexpr double kOtherUnit = 2.0;

std::vector<PosePair> Mirrored(std::vector<PosePair> pairs) {
  for (PosePair& pair : pairs) pair.estimate.translation().x() *= -1.0;
  return pairs;
}

}  // namespace

std::vector<std::string> JudgeShape(const std::vector<PosePair>& pairs, bool with_scale) {
  std::vector<std::string> warnings;
  try {
    const ShapeFit scaled = FitShape(pairs, true);
    const ShapeFit as_it_is = with_scale ? scaled : FitShape(pairs, false);
    const bool has_other_unit = scaled.scale > kOtherUnit || scaled.scale * kOtherUnit < 1.0;
    // Of a body that hardly moves, any scale fits.
    const bool has_shape = kFarBetter * scaled.rmse_m < SpreadOfTruth(pairs);
    if (!with_scale && has_other_unit && has_shape &&
        kFarBetter * scaled.rmse_m < as_it_is.rmse_m) {
      warnings.push_back(FormatText(
          "the positions of the ground truth are about %.4g times as large as those of the "
          "estimate: is one of them in another unit, such as mm? Both need metres "
          "(--alignment=sim3 aligns the scale)",
          scaled.scale));
    }
    const ShapeFit mirrored = FitShape(Mirrored(pairs), with_scale || has_other_unit);
    const double rmse_m = has_other_unit ? scaled.rmse_m : as_it_is.rmse_m;
    if (rmse_m > kSeen_m && kFarBetter * mirrored.rmse_m < rmse_m) {
      warnings.push_back(FormatText(
          "the ground truth fits the mirror image of the estimate far better (%.3g m in place of "
          "%.3g m): are its axes left-handed, or two of them exchanged?",
          mirrored.rmse_m, rmse_m));
    }
  } catch (const EvaluationError&) {
    // A line or a place has no shape.
  }
  return warnings;
}

}  // namespace trajlo
