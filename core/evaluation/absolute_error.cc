// SPDX-License-Identifier: MIT
#include "core/evaluation/absolute_error.h"

namespace trajlo {

PoseErrors AbsoluteErrors(const std::vector<PosePair>& aligned, bool with_orientation) {
  PoseErrors errors;
  for (const PosePair& pair : aligned) {
    errors.translation_m.push_back((pair.estimate.translation() - pair.truth.translation()).norm());
    if (with_orientation) AppendRotationErrors(RigidInverse(pair.estimate) * pair.truth, &errors);
  }
  return errors;
}

}  // namespace trajlo
