// SPDX-License-Identifier: MIT
#pragma once

namespace trajlo {

/// The most memory that this process ever held, MB (1e6 bytes).
double PeakMemoryMegabytes();

/// Processor time that this process has used so far, all threads, s.
double ProcessCpuSeconds();

}  // namespace trajlo
