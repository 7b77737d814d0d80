// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace trajlo {

/// A flag that cannot be understood; the message names it.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trajlo
