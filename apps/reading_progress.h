// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>

namespace trajlo {

/// "reading 45 % (67 of 150 messages)" on a line that is drawn over and over, if `stream` is a
/// terminal, and nothing otherwise.
class ReadingProgress {
 public:
  explicit ReadingProgress(std::FILE* stream, bool quiet = false);
  /// Clears the line.
  ~ReadingProgress();
  ReadingProgress(const ReadingProgress&) = delete;
  ReadingProgress& operator=(const ReadingProgress&) = delete;

  void Update(std::size_t done, std::size_t all);

 private:
  std::FILE* stream_;  ///< Null if nothing is drawn.
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace trajlo
