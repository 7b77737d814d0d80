// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace trajlo {

/// A command line that cannot be understood; the message names the flag or argument.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trajlo
