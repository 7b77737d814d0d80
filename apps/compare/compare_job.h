// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "apps/compare/compare_request.h"
#include "apps/exit_code.h"

namespace trajlo {

/// Compares until `stop`, writes the files, prints the tables and says what is wrong with the input
/// or the runs. Throws InputError and OutputError.
ExitCode RunComparison(const CompareRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
