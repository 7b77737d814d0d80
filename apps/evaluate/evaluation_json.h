// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// evaluation.json: every number, the settings that it depends on, versions and warnings. What was
/// not computed is null, with a reason beside it.
std::string EvaluationJson(const EvaluateRequest& request, const EvaluationReport& report);

}  // namespace trajlo
