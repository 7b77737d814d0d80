// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace trajlo {

/// What is reported of a list of errors, in the unit of the errors.
/// rmse = sqrt(mean(e²)); std with divisor n; the median of an even number is the mean of the two
/// in the middle; sse = sum of e². These are evo's definitions.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0, mean = 0.0, median = 0.0, std = 0.0, min = 0.0, max = 0.0, sse = 0.0;

  bool IsFinite() const;
};

/// All zero for an empty list: ask `count` before believing the rest.
ErrorStatistics ComputeStatistics(std::vector<double> errors);

}  // namespace trajlo
