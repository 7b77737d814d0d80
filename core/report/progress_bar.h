// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace trajlo {

struct Progress {
  std::size_t scan = 0;   ///< Scans processed.
  std::size_t scans = 0;  ///< Scans in the recording.
  double data_s = 0.0;    ///< Length of the data processed.
  double wall_s = 0.0;    ///< Time that this took.
  double inlier_share = 0.0;
  std::string_view of = {};  ///< Which of several runs this is; stands first.
};

/// "[=====>    ]  45 %  scan 67/150  3.2 x real time  inliers 82 %", within `columns`.
std::string ProgressLine(const Progress& progress, int columns);

/// "reading  45 % (67 of 150 messages)".
std::string ReadingLine(std::size_t done, std::size_t all);

/// One line that is drawn over and over, at most ten times a second, if `stream` is a terminal and
/// nothing at all otherwise.
class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* stream, bool quiet = false);
  /// Clears the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void Update(const Progress& progress);
  /// For messages that are read and not processed.
  void Update(std::size_t done, std::size_t all);

 private:
  /// True at most ten times a second.
  bool IsDue();
  void Draw(const std::string& line);

  std::FILE* stream_;  ///< Null if nothing is drawn.
  std::chrono::steady_clock::time_point drawn_{};
};

}  // namespace trajlo
