// SPDX-License-Identifier: MIT
#include "core/evaluation/shape_doubt.h"

#include <cmath>

#include "core/evaluation/alignment.h"
#include "core/evaluation/evaluation_error.h"
#include "core/io/format_text.h"

namespace trajlo {
namespace {

// Another unit, or a mirror image, is meant if positions agree better by this.
constexpr double kFarBetter = 4.0;
// An estimate may have a scale that is a little off; no unit of length is so near to another.
constexpr double kOtherUnit = 2.0;

// Less is rounding: a flat path and its mirror image fit alike.
constexpr double kSeen_m = 1e-3;

struct Fit {
  double rmse_m = 0.0;
  double scale = 1.0;
};

Fit FitOf(const std::vector<PosePair>& pairs, bool with_scale) {
  const Alignment alignment = Umeyama(pairs, with_scale);
  return {AlignedRmse_m(pairs, alignment), alignment.scale};
}

/// Of the true positions about their mean.
double SpreadOf(const std::vector<PosePair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) mean += pair.truth.translation();
  mean /= static_cast<double>(pairs.size());
  double squares = 0.0;
  for (const PosePair& pair : pairs) squares += (pair.truth.translation() - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(pairs.size()));
}

std::vector<PosePair> Mirrored(std::vector<PosePair> pairs) {
  for (PosePair& pair : pairs) pair.estimate.translation().x() *= -1.0;
  return pairs;
}

}  // namespace

std::vector<std::string> JudgeShape(const std::vector<PosePair>& pairs, bool with_scale) {
  std::vector<std::string> warnings;
  try {
    const Fit scaled = FitOf(pairs, true);
    const Fit as_it_is = with_scale ? scaled : FitOf(pairs, false);
    const bool has_other_unit = scaled.scale > kOtherUnit || scaled.scale * kOtherUnit < 1.0;
    // Of a body that hardly moves, any scale fits.
    const bool has_shape = kFarBetter * scaled.rmse_m < SpreadOf(pairs);
    if (!with_scale && has_other_unit && has_shape &&
        kFarBetter * scaled.rmse_m < as_it_is.rmse_m) {
      warnings.push_back(FormatText(
          "the positions of the ground truth are about %.4g times as large as those of the "
          "estimate: is one of them in another unit, such as mm? Both need metres "
          "(--alignment=sim3 aligns the scale)",
          scaled.scale));
    }
    const Fit mirrored = FitOf(Mirrored(pairs), with_scale || has_other_unit);
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
