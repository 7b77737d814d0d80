// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "apps/compare/compare_report.h"

namespace trajlo {

/// What the truth makes doubtful about the runs: each sentence once, with the runs it is about.
std::vector<std::string> WarningsOfRuns(const CompareReport& report);
/// In the same way, why runs could not be compared with the truth.
std::vector<std::string> FailuresOfRuns(const CompareReport& report);

}  // namespace trajlo
