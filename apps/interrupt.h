// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace trajlo {

/// From now on SIGINT, SIGTERM and SIGHUP set the flag that is returned, so that the run can write
/// what it has; a second signal ends the process at once, as usual. Later calls change nothing.
const std::atomic<bool>& HandleInterrupts();

}  // namespace trajlo
