// SPDX-License-Identifier: MIT
#pragma once

#include "apps/evaluate/evaluation_report.h"
#include "apps/exit_code.h"

namespace trajlo {

/// Reads, compares, prints the table and writes the output. Estimates that could not be compared
/// with the truth are named on stderr: kPartialInput if they are some, kInputUnreadable if all.
/// Throws InputError (truth, stamps) and OutputError.
ExitCode EvaluateJob(const EvaluateRequest& request);

}  // namespace trajlo
