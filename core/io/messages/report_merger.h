// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// Adds to the report of a reader what is new in the report of another that it reads from.
class ReportMerger {
 public:
  void Take(const MessageReport& from, MessageReport* to) {
    to->damaged = to->damaged || from.damaged;
    to->bytes_lost += from.bytes_lost - bytes_lost_taken_;
    bytes_lost_taken_ = from.bytes_lost;
    for (; warnings_taken_ < from.warnings.size(); ++warnings_taken_) {
      to->warnings.push_back(from.warnings[warnings_taken_]);
    }
  }

 private:
  std::size_t warnings_taken_ = 0;
  std::uint64_t bytes_lost_taken_ = 0;
};

}  // namespace trajlo
