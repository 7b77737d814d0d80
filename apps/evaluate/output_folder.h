// SPDX-License-Identifier: MIT
#pragma once

#include "apps/evaluate/evaluation_report.h"

namespace trajlo {

/// Throws OutputError if the path is no folder, or if it holds an evaluation and `overwrite` is
/// false. Changes nothing.
void CheckEvaluationFolder(const std::filesystem::path& folder, bool overwrite);

/// Writes evaluation.csv, evaluation.tex, errors_<name>.csv and, when all else is there,
/// evaluation.json. What an earlier evaluation left goes first. Throws OutputError.
void WriteEvaluation(const EvaluateRequest& request, const EvaluationReport& report);

}  // namespace trajlo
