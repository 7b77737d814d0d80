// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

namespace trajlo {

/// Two trajectories that cannot be compared as asked: no overlap in time, too few poses for the
/// alignment, ... The message says what was found and what can be done.
class EvaluationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace trajlo
