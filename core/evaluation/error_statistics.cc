// SPDX-License-Identifier: MIT
#include "core/evaluation/error_statistics.h"

#include <algorithm>
#include <cmath>

namespace trajlo {

bool ErrorStatistics::IsFinite() const { return std::isfinite(sse) && std::isfinite(max); }

ErrorStatistics ComputeStatistics(std::vector<double> errors) {
  ErrorStatistics s;
  s.count = errors.size();
  if (errors.empty()) return s;
  const double n = static_cast<double>(errors.size());
  double sum = 0.0;
  for (const double e : errors) {
    sum += e;
    s.sse += e * e;
  }
  s.mean = sum / n;
  s.rmse = std::sqrt(s.sse / n);
  double squares = 0.0;
  for (const double e : errors) squares += (e - s.mean) * (e - s.mean);
  s.std = std::sqrt(squares / n);
  std::sort(errors.begin(), errors.end());
  s.min = errors.front();
  s.max = errors.back();
  const std::size_t half = errors.size() / 2;
  s.median = errors.size() % 2 == 1 ? errors[half] : 0.5 * (errors[half - 1] + errors[half]);
  return s;
}

}  // namespace trajlo
