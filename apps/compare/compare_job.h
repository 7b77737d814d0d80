// SPDX-License-Identifier: MIT
#pragma once

#include "apps/compare/compare_request.h"
#include "apps/run/exit_code.h"

namespace trajlo {

/// Does what was asked for and tells the outcome; errors are printed.
ExitCode RunComparison(const CompareRequest& request);

}  // namespace trajlo
