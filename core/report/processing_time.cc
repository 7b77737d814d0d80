// SPDX-License-Identifier: MIT
#include "core/report/processing_time.h"

#include <algorithm>
#include <map>

#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// What less data takes says nothing of a second.
constexpr std::int64_t kShortest_ns = kNsPerSecond / 2;

}  // namespace

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

void ProcessingTime::Add(std::int64_t t_ns, double milliseconds) {
  samples_.push_back({t_ns, milliseconds});
  total_ms_ += milliseconds;
}

ProcessingTime::Quantiles ProcessingTime::PerSecondOfData(std::int64_t end_ns) const {
  if (samples_.empty()) return {};
  const std::int64_t begin_ns = samples_.front().t_ns;
  const std::int64_t duration_ns = end_ns - begin_ns;
  if (duration_ns < kShortest_ns) return {};
  const std::int64_t bins =
      std::max<std::int64_t>((duration_ns + kNsPerSecond / 2) / kNsPerSecond, 1);
  // A map, as a recording with a pause of years has years of empty seconds: they count as nothing.
  std::map<std::int64_t, double> milliseconds;
  for (const Sample& sample : samples_) {
    const std::int64_t bin = (sample.t_ns - begin_ns) / kNsPerSecond;
    milliseconds[std::clamp<std::int64_t>(bin, 0, bins - 1)] += sample.milliseconds;
  }
  std::vector<double> values;
  for (const auto& [bin, spent] : milliseconds) {
    const std::int64_t length_ns =
        bin < bins - 1 ? kNsPerSecond : duration_ns - (bins - 1) * kNsPerSecond;
    values.push_back(spent * static_cast<double>(kNsPerSecond) / static_cast<double>(length_ns));
  }
  return {Quantile(values, 0.5), Quantile(values, 0.95)};
}

}  // namespace trajlo
