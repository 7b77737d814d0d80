// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace trajlo::testing {

/// The bytes of `count` numbers, or of what is made of numbers: equal only to the last bit.
template <typename T>
std::string_view BytesOf(const T* first, std::size_t count) {
  return {reinterpret_cast<const char*>(first), count * sizeof(T)};
}

}  // namespace trajlo::testing
