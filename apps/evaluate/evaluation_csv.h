// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// evaluation.csv: a row for each estimate, a column for each number; empty where there is none.
std::string EvaluationCsv(const EvaluateRequest& request, const EvaluationReport& report);

/// errors_<name>.csv: a row for each pair, poses of the aligned estimate and of the truth and the
/// errors between them. t_s is the clock of the truth (the number of the line without stamps);
/// rotation_error_deg is empty if the truth has no orientation.
std::string ErrorsCsv(const Evaluation& evaluation, bool has_stamps);

}  // namespace trajlo
