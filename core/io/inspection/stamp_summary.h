// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace trajlo {

/// A step between two stamps that is longer than one and a half periods.
struct StampGap {
  /// The stamp before it.
  std::int64_t after_ns = 0;
  std::int64_t length_ns = 0;
};

/// How the stamps of a stream of messages run, in the order of the messages.
struct StampSummary {
  std::size_t count = 0;
  std::int64_t first_ns = 0;
  std::int64_t last_ns = 0;
  /// The median step, s; 0 with fewer than two stamps.
  double period_s = 0.0;
  /// Of the steps that are neither gaps, duplicates nor backwards, against the period, s.
  double jitter_s = 0.0;             ///< Root mean square.
  double largest_deviation_s = 0.0;  ///< Absolute.
  std::vector<StampGap> gaps;
  /// As many as fit into the gaps.
  std::size_t missing = 0;
  std::size_t duplicates = 0;
  std::optional<std::int64_t> first_duplicate_ns;
  std::size_t steps_back = 0;
  /// The first stamp that is earlier than the one before it.
  std::optional<std::int64_t> first_step_back_ns;
  double largest_step_back_s = 0.0;
  /// From the stamp to the recording of the message, s; nothing if the time of recording is
  /// unknown.
  struct Delay {
    double least = 0.0, median = 0.0, most = 0.0;
  };
  std::optional<Delay> recorded_after_s;
};

/// `recorded_ns` is empty or as long as `stamps_ns`.
StampSummary SummariseStamps(const std::vector<std::int64_t>& stamps_ns,
                             const std::vector<std::int64_t>& recorded_ns);

}  // namespace trajlo
