// SPDX-License-Identifier: MIT
#include "core/report/flag_warnings.h"

#include <algorithm>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

/// Less than this share of the time is not worth a warning.
constexpr double kWorthSaying = 0.02;

std::string SecondsText(double seconds, double all_s) {
  return FormatText("%.2f s (%.1f %%)", seconds, 100.0 * seconds / all_s);
}

/// "about_z" as "about z of the body".
std::string Words(const std::string& axis) {
  if (axis.rfind("about_", 0) == 0) return "rotation about " + axis.substr(6) + " of the body";
  return "motion along " + axis + " of the body";
}

}  // namespace

std::vector<std::string> FlagWarnings(const RunSummary& summary) {
  std::vector<std::string> warnings;
  const double all_s = summary.flags.seconds();
  if (!(all_s > 0.0)) return warnings;
  const auto total = [&](const char* name) { return summary.flags.totals().at(name); };
  const auto warn_of_share = [&](const char* name, const std::string& what) {
    const double seconds = total(name).seconds;
    if (!(seconds > kWorthSaying * all_s)) return;
    warnings.push_back("for " + SecondsText(seconds, all_s) + what + " (flag " + name + ")");
  };

  const FlaggedPoses gap = total("gap");
  if (gap.control_poses > 0) {
    warnings.push_back("for " + SecondsText(gap.seconds, all_s) + " in " +
                       std::to_string(gap.control_poses) +
                       (gap.control_poses == 1 ? " stretch" : " stretches") +
                       " nothing was measured, or the place was not found; the motion in between "
                       "is unknown (flag gap in flags.csv)");
  }
  // Of a recording without a window the message says more.
  if (!summary.too_short) {
    warn_of_share("no_points",
                  " hardly any point lay on the map; the motion prior carries the poses there");
  }
  const auto& axes = summary.windows.weak_axes;
  if (!axes.empty()) {
    const auto weakest = std::max_element(
        axes.begin(), axes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    warn_of_share("degenerate", " the points leave a direction open, mostly " +
                                    Words(weakest->first) +
                                    "; the poses may be off by more than it seems");
  }
  warn_of_share("few_inliers", " too few points agree with the map; the poses there may be wrong");
  warn_of_share("jump",
                " poses jump further than a body can move, or have been in doubt since then; they "
                "may be wrong");
  warn_of_share("lone_object",
                " one object alone holds a direction, and the rest of the world contradicts it: it "
                "may move along with the body, as a truck ahead does");
  return warnings;
}

}  // namespace trajlo
