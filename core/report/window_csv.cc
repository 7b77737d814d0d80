// SPDX-License-Identifier: MIT
#include "core/report/window_csv.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "core/io/stamp_text.h"
#include "core/report/csv_row.h"
#include "core/report/window_columns.h"

namespace trajlo {
namespace {

/// Times are exact to the nanosecond, as text.
class WindowRow : public CsvRow {
 public:
  void AddTime(const char* name, std::int64_t t_ns) { Add(name, FormatSeconds(t_ns)); }
};

WindowRow MakeRow(const WindowStatistics& window) {
  WindowRow row;
  AddWindowColumns(window, &row);
  return row;
}

}  // namespace

std::string FlagNames(unsigned flags) {
  static const std::vector<std::pair<unsigned, const char*>> names = {
      {kFlagNoPoints, "no_points"},     {kFlagGap, "gap"},
      {kFlagReverted, "reverted"},      {kFlagNotConverged, "not_converged"},
      {kFlagDegenerate, "degenerate"},  {kFlagLost, "lost"},
      {kFlagFewInliers, "few_inliers"}, {kFlagJump, "jump"},
      {kFlagLoneObject, "lone_object"},
  };
  std::string text;
  for (const auto& [flag, name] : names) {
    if ((flags & flag) != 0) text += (text.empty() ? "" : "|") + std::string(name);
  }
  return text;
}

std::string AxisName(const Vector6d& direction) {
  static const char* const names[] = {"x", "y", "z", "about_x", "about_y", "about_z"};
  int largest = 0;
  const double size = direction.cwiseAbs().maxCoeff(&largest);
  return size > 0.0 ? names[largest] : "";
}

WindowCsvWriter::WindowCsvWriter(const std::filesystem::path& path, IfExists if_exists)
    : file_(path, if_exists) {
  file_.Write(MakeRow({}).Names());
}

void WindowCsvWriter::Append(const WindowStatistics& window) {
  file_.Write(MakeRow(window).Values());
}

}  // namespace trajlo
