// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "core/io/output_file.h"
#include "core/odometry/health/window_statistics.h"

namespace trajlo {

/// Writes one line per window while the run goes on; each line is one write(2) of its own, so a
/// killed process leaves whole lines. Members throw OutputError.
class WindowCsvWriter {
 public:
  explicit WindowCsvWriter(const std::filesystem::path& path, IfExists if_exists = IfExists::kFail);

  void Append(const WindowStatistics& window);
  void Close() { file_.Close(); }

 private:
  OutputFile file_;
};

/// "gap|lost", or empty: the names of the set bits in the order of WindowFlag.
std::string FlagNames(unsigned flags);

/// The body axis that a tangent direction [rho; theta] is mostly along: "x", "y", "z" for a
/// translation, "about_x" ... for a rotation; empty for the zero vector.
std::string AxisName(const Vector6d& direction);

}  // namespace trajlo
