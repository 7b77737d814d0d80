// SPDX-License-Identifier: MIT
#include "core/io/recording/excerpt.h"

namespace trajlo {
namespace {

/// Scans of several LiDARs are not quite in the order of their stamps: one that is late by up to
/// this much still belongs to the excerpt.
constexpr std::int64_t kOverlapNs = 1'000'000'000;

}  // namespace

bool Excerpt::Next(LidarScan* scan) {
  while (whole_->Next(scan)) {
    if (!first_ns_) first_ns_ = scan->stamp_ns;
    const std::int64_t begin_ns = *first_ns_ + start_ns_;
    if (scan->stamp_ns < begin_ns) continue;
    if (duration_ns_ == 0 || scan->stamp_ns < begin_ns + duration_ns_) return true;
    if (scan->stamp_ns >= begin_ns + duration_ns_ + kOverlapNs) return false;
  }
  return false;
}

}  // namespace trajlo
