// SPDX-License-Identifier: MIT
#include "core/evaluation/completeness.h"

#include <algorithm>

#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {

double Completeness(const TimedPoses& estimate, const TimedPoses& truth,
                    std::int64_t time_offset_ns, double max_gap_s) {
  if (!estimate.HasStamps() || !truth.HasStamps()) return 1.0;
  const std::int64_t max_gap_ns = Nanoseconds(max_gap_s);
  const auto covered = std::count_if(truth.t_ns.begin(), truth.t_ns.end(), [&](std::int64_t t) {
    return FindInterval(estimate.t_ns, t - time_offset_ns, max_gap_ns).has_value();
  });
  return static_cast<double>(covered) / static_cast<double>(truth.size());
}

}  // namespace trajlo
