// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace trajlo {

/// The standard deviation of normal noise, in medians of its sizes (P. Huber, Robust Statistics,
/// 1981).
inline constexpr double kSigmaOfMedian = 1.4826;

/// Of an even number of values the larger of the two in the middle; 0 of none.
template <typename T>
T UpperMedian(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of an even number of values the smaller of the two in the middle; 0 of none.
template <typename T>
T LowerMedian(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace trajlo
