// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// What is printed: all statistics of a single estimate, or a row for each of several, with the
/// best values marked, and below how it was computed.
std::string EvaluationTable(const EvaluateRequest& request, const EvaluationReport& report);

}  // namespace trajlo
