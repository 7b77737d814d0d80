// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/report/run_summary.h"

namespace trajlo {

/// What a user has to know about poses that are not as good as the others: stretches of which
/// nothing was measured, and directions that the points do not hold. One sentence each; none for a
/// good run.
std::vector<std::string> FlagWarnings(const RunSummary& summary);

}  // namespace trajlo
