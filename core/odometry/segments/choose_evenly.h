// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace trajlo {

/// At most `count` of the elements, at even distances in their order.
template <typename T>
std::vector<T> ChooseEvenly(const std::vector<T>& all, std::size_t count) {
  if (all.size() <= count) return all;
  std::vector<T> chosen;
  chosen.reserve(count);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[i * all.size() / count]);
  return chosen;
}

/// The stride that looks at no more than `about` of `count` elements, and at half as many at least.
inline std::size_t StrideForAbout(std::size_t about, std::size_t count) {
  return 1 + count / about;
}

}  // namespace trajlo
