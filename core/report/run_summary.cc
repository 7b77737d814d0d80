// SPDX-License-Identifier: MIT
#include "core/report/run_summary.h"

namespace trajlo {

double RunSummary::ShareWithWrongTimes() const {
  if (points.received == 0) return 0.0;
  const auto dropped =
      points.too_late + points.wrong_time + static_cast<std::int64_t>(read.points_without_time);
  return static_cast<double>(dropped) / static_cast<double>(points.received);
}

std::string RunSummary::OddStamps() const {
  std::string text;
  const auto add = [&](std::int64_t count, const char* what) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(times.reordered, "put in order");
  add(times.retimed, "given the time between their neighbours (wrong stamps)");
  add(times.assumed, "given an assumed time (the stamps stand still)");
  add(times.misfits, "dropped (their stamps fit nowhere)");
  add(times.repeated, "dropped (repeated)");
  add(times.apart, "left out (their clock does not meet that of the first LiDAR)");
  return text;
}

}  // namespace trajlo
