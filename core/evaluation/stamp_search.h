// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace trajlo {

/// The distance of two stamps as a program sees it that holds stamps as doubles of seconds: since
/// 1970 they are rounded to 0.2 us. The tools that define "nearest" do so, and their published
/// numbers depend on which of two equally near poses that lets win.
inline double RoundedDistance_s(std::int64_t a_ns, std::int64_t b_ns) {
  const auto seconds = [](std::int64_t t_ns) {
    return static_cast<double>(static_cast<long double>(t_ns) / 1e9L);
  };
  return std::abs(seconds(a_ns) - seconds(b_ns));
}

/// The index of the stamp nearest to t by RoundedDistance_s(), the first of several that are
/// equally near. `t_ns` does not decrease and is not empty.
inline std::size_t Nearest(const std::vector<std::int64_t>& t_ns, std::int64_t t) {
  const auto after = std::lower_bound(t_ns.begin(), t_ns.end(), t);
  const std::size_t i = static_cast<std::size_t>(after - t_ns.begin());
  if (i == 0 ||
      (after != t_ns.end() && RoundedDistance_s(t_ns[i], t) < RoundedDistance_s(t_ns[i - 1], t))) {
    return i;
  }
  std::size_t before = i - 1;
  while (before > 0 && t_ns[before - 1] == t_ns[before]) --before;
  return before;
}

/// A place between two stamps: t_ns[begin] + fraction (t_ns[begin + 1] - t_ns[begin]), with
/// fraction 0 on a stamp, also on the last one.
struct StampInterval {
  std::size_t begin = 0;
  double fraction = 0.0;
};

/// Where t lies among stamps that do not decrease; nothing outside of them and inside a gap longer
/// than `max_gap_ns`.
inline std::optional<StampInterval> FindInterval(const std::vector<std::int64_t>& t_ns,
                                                 std::int64_t t, std::int64_t max_gap_ns) {
  const auto after = std::upper_bound(t_ns.begin(), t_ns.end(), t);
  if (after == t_ns.begin()) return {};
  const std::size_t begin = static_cast<std::size_t>(after - t_ns.begin()) - 1;
  if (t_ns[begin] == t) return StampInterval{begin, 0.0};
  if (after == t_ns.end()) return {};
  const std::int64_t gap = *after - t_ns[begin];
  if (gap > max_gap_ns) return {};
  return StampInterval{begin, static_cast<double>(t - t_ns[begin]) / static_cast<double>(gap)};
}

}  // namespace trajlo
