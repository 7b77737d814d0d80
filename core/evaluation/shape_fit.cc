// SPDX-License-Identifier: MIT
#include "core/evaluation/shape_fit.h"

#include <cmath>

#include "core/evaluation/alignment.h"

namespace trajlo {

ShapeFit FitShape(const std::vector<PosePair>& pairs, bool with_scale) {
  const Alignment alignment = Umeyama(pairs, with_scale);
  return {AlignedRmse_m(pairs, alignment), alignment.scale};
}

double SpreadOfTruth(const std::vector<PosePair>& pairs) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const PosePair& pair : pairs) mean += pair.truth.translation();
  mean /= static_cast<double>(pairs.size());
  double squares = 0.0;
  for (const PosePair& pair : pairs) squares += (pair.truth.translation() - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(pairs.size()));
}

}  // namespace trajlo
