// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

#include "apps/exit_code.h"
#include "apps/run/run_request.h"

namespace trajlo {

/// Reads the recording, estimates, and writes the results while it goes on. Problems are printed
/// to stderr, and what was achieved until then is kept. `stop` ends the reading early.
ExitCode RunJob(const RunRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
