// SPDX-License-Identifier: MIT
// The words by which configs and messages name the parts of a time convention.
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

std::optional<TimeUnit> ParseTimeUnit(const std::string& text) {
  for (const TimeUnit unit : {TimeUnit::kAuto, TimeUnit::kSeconds, TimeUnit::kMilliseconds,
                              TimeUnit::kMicroseconds, TimeUnit::kNanoseconds}) {
    if (text == NameOf(unit)) return unit;
  }
  return {};
}

std::optional<TimeOrigin> ParseTimeOrigin(const std::string& text) {
  if (text == "auto") return TimeOrigin::kAuto;
  if (text == "start") return TimeOrigin::kSweepStart;
  if (text == "stamp") return TimeOrigin::kStamp;
  if (text == "end") return TimeOrigin::kSweepEnd;
  if (text == "absolute") return TimeOrigin::kAbsolute;
  return {};
}

std::optional<StampAt> ParseStampAt(const std::string& text) {
  if (text == "auto") return StampAt::kAuto;
  if (text == "start") return StampAt::kStart;
  if (text == "end") return StampAt::kEnd;
  return {};
}

}  // namespace trajlo
