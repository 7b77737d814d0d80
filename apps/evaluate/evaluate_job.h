// SPDX-License-Identifier: MIT
#pragma once

#include "apps/evaluate/evaluation_report.h"
#include "apps/run/exit_code.h"

namespace trajlo {

/// Reads, compares, prints the table and writes the output. Problems are printed to stderr.
/// kPartialInput if some of several estimates could not be compared with the truth.
ExitCode EvaluateJob(const EvaluateRequest& request);

}  // namespace trajlo
