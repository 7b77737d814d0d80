// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace trajlo {

/// Wall time since it was made or last read.
class Stopwatch {
 public:
  double Seconds() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }
  double Milliseconds() { return 1e3 * Seconds(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace trajlo
