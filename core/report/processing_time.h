// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace trajlo {

/// How many milliseconds of work each second of data costs.
class ProcessingTime {
 public:
  struct Quantiles {
    double median_ms = 0.0;
    double p95_ms = 0.0;
  };

  /// `milliseconds` of work were spent on the data that begins at `t_ns`.
  void Add(std::int64_t t_ns, double milliseconds);

  /// Over the seconds of data, counted from the first one; `end_ns` is where the data ends. A last
  /// second that is not full is scaled up if it is at least half, else it counts to the one before.
  Quantiles PerSecondOfData(std::int64_t end_ns) const;

  double total_ms() const { return total_ms_; }

 private:
  struct Sample {
    std::int64_t t_ns;
    double milliseconds;
  };
  std::vector<Sample> samples_;
  double total_ms_ = 0.0;
};

/// The value below which a share `q` of `values` lies, interpolated; 0 if there are none.
double Quantile(std::vector<double> values, double q);

}  // namespace trajlo
