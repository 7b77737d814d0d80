// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// evaluation.tex: a row of a LaTeX tabular for each estimate, to be included into a table of
/// one's own. The best values are bold, runs that diverged have a cross. A comment names the
/// columns.
std::string EvaluationTex(const EvaluateRequest& request, const EvaluationReport& report);

}  // namespace trajlo
