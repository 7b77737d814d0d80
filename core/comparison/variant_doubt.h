// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/comparison/solver_variant.h"

namespace trajlo {

/// A sentence for each variant that sets what has no effect, or that is another one under a new
/// name: what tells those apart is noise. `lockstep`: windows are compared, too.
std::vector<std::string> DoubtVariants(const std::vector<SolverVariant>& variants,
                                       const RunConfig& base, bool lockstep);

}  // namespace trajlo
