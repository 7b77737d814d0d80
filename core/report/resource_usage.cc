// SPDX-License-Identifier: MIT
#include "core/report/resource_usage.h"

#include <sys/resource.h>

#include <ctime>

#include "core/scans/nanoseconds.h"

namespace trajlo {

double PeakMemoryMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1e-6 * 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts in KiB.
}

double ProcessCpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + Seconds(now.tv_nsec);
}

}  // namespace trajlo
