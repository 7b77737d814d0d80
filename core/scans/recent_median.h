// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/scans/median.h"

namespace trajlo {

/// The lower median of the last 16 values.
class RecentMedian {
 public:
  void Add(std::int64_t value) {
    if (values_.size() < kMost) {
      values_.push_back(value);
    } else {
      values_[next_] = value;
    }
    next_ = (next_ + 1) % kMost;
  }
  std::size_t size() const { return values_.size(); }
  /// Empty if there is no value.
  std::optional<std::int64_t> Value() const {
    return values_.empty() ? std::nullopt : std::optional(LowerMedian(values_));
  }

 private:
  static constexpr std::size_t kMost = 16;
  std::vector<std::int64_t> values_;
  std::size_t next_ = 0;
};

}  // namespace trajlo
