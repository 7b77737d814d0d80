// SPDX-License-Identifier: MIT
// The units of times, and the words by which messages name the parts of a time convention.
#include "core/io/time_convention.h"

namespace trajlo {

std::int64_t NanosecondsPer(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kMilliseconds:
      return 1'000'000;
    case TimeUnit::kMicroseconds:
      return 1'000;
    case TimeUnit::kNanoseconds:
      return 1;
    default:
      return 1'000'000'000;
  }
}

const char* NameOf(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kAuto:
      return "auto";
    case TimeUnit::kMilliseconds:
      return "ms";
    case TimeUnit::kMicroseconds:
      return "us";
    case TimeUnit::kNanoseconds:
      return "ns";
    default:
      return "s";
  }
}

const char* NameOf(TimeOrigin origin) {
  switch (origin) {
    case TimeOrigin::kAuto:
      return "auto";
    case TimeOrigin::kSweepStart:
      return "start";
    case TimeOrigin::kStamp:
      return "stamp";
    case TimeOrigin::kSweepEnd:
      return "end";
    default:
      return "absolute";
  }
}

}  // namespace trajlo
