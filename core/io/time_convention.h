// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/point_table.h"

namespace trajlo {

enum class TimeUnit { kAuto, kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };

/// What a time of zero in the file means. kStamp: the scan's stamp, which lies inside the sweep.
enum class TimeOrigin { kAuto, kSweepStart, kStamp, kSweepEnd, kAbsolute };

/// Which end of the sweep the scan's stamp marks.
enum class StampAt { kAuto, kStart, kEnd };

/// What the user fixes; everything that is left `kAuto` or empty is decided by evidence.
struct TimeOptions {
  /// False: ignore per-point times; every point gets the scan's stamp.
  bool use_point_times = true;
  /// Name of the field with the times; empty: the first with a known name.
  std::string field;
  TimeUnit unit = TimeUnit::kAuto;
  TimeOrigin origin = TimeOrigin::kAuto;
  StampAt stamp_at = StampAt::kAuto;
};

/// The range of the time field in one scan, in the file's own unit, without points whose times are
/// far from those of the others.
struct TimeSample {
  double first = 0.0;
  double last = 0.0;
  /// Points with a time and a position.
  std::size_t points = 0;
  std::optional<std::int64_t> stamp_ns;
  /// When the message was recorded; a message is sent after its last point was measured.
  std::optional<std::int64_t> recorded_ns;
};

/// What is known about the time field from the first scans of a recording.
struct TimeEvidence {
  std::filesystem::path path;
  std::string field;
  ScalarType type = ScalarType::kFloat32;
  std::vector<TimeSample> samples;
  /// Typical time between two stamps, s; 0 if there are no stamps.
  double period_s = 0.0;
};

/// How the time field becomes `LidarPoint::t_ns`.
struct TimeConvention {
  /// Empty: the points have no times of their own.
  std::string field;
  TimeUnit unit = TimeUnit::kSeconds;
  TimeOrigin origin = TimeOrigin::kSweepStart;
  StampAt stamp_at = StampAt::kStart;
  /// Nothing told which end the stamp marks.
  bool stamp_at_is_assumed = false;
  /// Duration of one sweep; it separates the two ends of a sweep.
  std::int64_t sweep_ns = 0;
  /// For absolute times of another clock than the stamps': added to reach the stamps' clock.
  std::int64_t clock_offset_ns = 0;
  /// Why: one or two sentences with numbers, to be printed.
  std::string evidence;
  /// A sentence that names the option to set, where the decision may be wrong; or empty.
  std::string doubt;

  bool HasPointTimes() const { return !field.empty(); }
  bool IsAbsolute() const { return origin == TimeOrigin::kAbsolute; }
  /// What a time of zero in the file means, as nanoseconds after the scan's stamp; for relative
  /// times only.
  std::int64_t ZeroAfterStampNs() const;
};

std::int64_t NanosecondsPer(TimeUnit unit);
/// "s", "ms", "us", "ns"
const char* NameOf(TimeUnit unit);
/// "start", "stamp", "end", "absolute"
const char* NameOf(TimeOrigin origin);

/// Decides unit and origin: the unit is the one that makes a scan's span one sweep (compared with
/// the period of the stamps, else with plausible sweeps), the origin follows from where zero and
/// the stamps lie. One scan of several may be broken. Throws InputError with all the numbers when
/// the evidence allows no decision.
///
/// Which end of a sweep the stamps mark shows where a sweep was cut short: the next stamp, or the
/// one before, is as near. Else the time of recording tells, as a sweep is sent when it is
/// complete, unless it is a copy of the stamp. Sweeps of one length join in either case, and give
/// the same trajectory, a sweep earlier or later: without evidence the start is taken, with a
/// doubt.
TimeConvention DeduceTimeConvention(const TimeEvidence& evidence, const TimeOptions& options);

}  // namespace trajlo
