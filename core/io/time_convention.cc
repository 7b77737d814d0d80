// SPDX-License-Identifier: MIT
#include "core/io/time_convention.h"

#include <algorithm>
#include <cmath>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/scan_stamps.h"
#include "core/io/stamp_end.h"
#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

constexpr TimeUnit kUnits[] = {TimeUnit::kSeconds, TimeUnit::kMilliseconds, TimeUnit::kMicroseconds,
                               TimeUnit::kNanoseconds};
/// Bounds what a wrong unit given by the user can do.
constexpr double kLongestSweep = 1000.0;
constexpr char kMend[] =
    "Set input.time_unit (s, ms, us, ns) and input.time_origin (start, stamp, end, absolute), or "
    "another input.time_field; for motion-corrected scans, input.point_time=none.";

std::string Number(double value) { return FormatText("%.9g", value); }

/// Of four scans, one may be broken; of fewer, none.
std::size_t BrokenAllowed(const std::vector<TimeSample>& samples) {
  return samples.size() >= 4 ? 1 : 0;
}

/// The evidence of several scans in a few numbers, in the file's unit.
struct Summary {
  double first = 0.0, last = 0.0, span = 0.0, size = 0.0;
};

Summary Summarise(const std::vector<TimeSample>& samples) {
  std::vector<double> firsts, lasts, spans, sizes;
  for (const TimeSample& sample : samples) {
    firsts.push_back(sample.first);
    lasts.push_back(sample.last);
    spans.push_back(sample.last - sample.first);
    sizes.push_back(std::max(std::abs(sample.first), std::abs(sample.last)));
  }
  return {UpperMedian(firsts), UpperMedian(lasts), UpperMedian(spans), UpperMedian(sizes)};
}

std::string Describe(const TimeEvidence& evidence, const Summary& summary) {
  std::string text = "field '" + evidence.field + "' (" + NameOf(evidence.type) + ") runs from " +
                     Number(summary.first) + " to " + Number(summary.last) + " in a scan";
  text += evidence.period_s > 0.0 ? ", stamps are " + Number(evidence.period_s) + " s apart"
                                  : std::string(", there are no stamps to compare with");
  return text;
}

bool Float32LostTheTime(const TimeEvidence& evidence, const Summary& summary) {
  if (evidence.type != ScalarType::kFloat32 || summary.size == 0.0) return false;
  const auto size = static_cast<float>(summary.size);
  const double step = std::nextafter(size, INFINITY) - size;
  return summary.span < 1000.0 * step && summary.size > 1000.0 * summary.span;
}

/// The units are a factor of 1000 apart and the window is only 100 wide, so at most one fits.
TimeUnit DeduceUnit(const TimeEvidence& evidence, const Summary& summary) {
  const double shortest_s = evidence.period_s > 0.0 ? 0.05 * evidence.period_s : 0.005;
  const double longest_s = 100.0 * shortest_s;
  std::string readings;
  for (const TimeUnit unit : kUnits) {
    const double span_s = summary.span * Seconds(NanosecondsPer(unit));
    if (span_s >= shortest_s && span_s <= longest_s) return unit;
    readings += (readings.empty() ? "" : ", ") + Number(span_s) + " s if in " + NameOf(unit);
  }
  const std::string doubt = DoubtOfStampUnit(evidence.period_s);
  if (!doubt.empty()) {
    throw InputError(evidence.path,
                     doubt + " (field '" + evidence.field + "' runs from " + Number(summary.first) +
                         " to " + Number(summary.last) + " in a scan)",
                     "Write the stamps in s; or, if they are right, set input.time_unit.");
  }
  throw InputError(evidence.path,
                   "ambiguous point times: " + Describe(evidence, summary) +
                       "; a sweep would take " + readings + ", and none of these lies between " +
                       Number(shortest_s) + " and " + Number(longest_s) + " s",
                   kMend);
}

/// What is wrong with a unit that was told, where the stamps show a sweep of quite another length.
std::string DoubtOfUnit(const TimeEvidence& evidence, TimeUnit unit, double span_s) {
  if (evidence.period_s <= 0.0) return "";
  const double periods = span_s / evidence.period_s;
  if (periods >= 0.05 && periods <= 5.0) return "";  // As in DeduceUnit().
  return "input.time_unit=" + std::string(NameOf(unit)) + " makes a sweep take " + Number(span_s) +
         " s, but stamps are " + Number(evidence.period_s) +
         " s apart: check it, or leave it at auto";
}

/// True if zero lies within the sweep or close to one of its ends. Where a part of the sweep has no
/// returns, the period tells how long it is.
bool IsRelative(const TimeEvidence& evidence, TimeUnit unit, double seen) {
  const double period = evidence.period_s / Seconds(NanosecondsPer(unit));
  const double span = std::max(seen, period);
  const std::vector<TimeSample>& samples = evidence.samples;
  const auto broken = std::count_if(samples.begin(), samples.end(), [&](const TimeSample& sample) {
    return sample.first < -1.25 * span || sample.last > 1.25 * span;
  });
  return static_cast<std::size_t>(broken) <= BrokenAllowed(samples);
}

TimeOrigin RelativeOrigin(const Summary& summary) {
  if (summary.first >= -0.1 * summary.span) return TimeOrigin::kSweepStart;
  if (summary.last <= 0.1 * summary.span) return TimeOrigin::kSweepEnd;
  return TimeOrigin::kStamp;
}

/// From the smallest to the largest value, without the `left_out` farthest from the median.
double RangeOfMost(std::vector<double> values, std::size_t left_out) {
  const double middle = UpperMedian(values);
  std::sort(values.begin(), values.end(),
            [&](double a, double b) { return std::abs(a - middle) < std::abs(b - middle); });
  values.resize(values.size() - std::min(left_out, values.size() - 1));
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least;
}

/// Where absolute times lie that are of the stamps' clock; with a doubt if that is several sweeps
/// away.
void DescribeDistance(double stamp_after_first_s, double stamp_after_last_s,
                      TimeConvention* found) {
  constexpr double kFewSweeps = 3.0;
  const std::string where = "the stamp lies " + BeforeOrAfter(stamp_after_first_s) +
                            " the first point and " + BeforeOrAfter(stamp_after_last_s) +
                            " the last";
  found->evidence += "; the times are absolute, " + where;
  const double nearest_s = std::min(std::abs(stamp_after_first_s), std::abs(stamp_after_last_s));
  if (nearest_s < kFewSweeps * Seconds(found->sweep_ns)) return;
  found->doubt = where +
                 ", more than a few sweeps can explain; the result has the times of the points "
                 "(input.clock_offset_s moves them)";
}

/// Settles which clock absolute times belong to, by their distance from the stamps.
void CompareClocks(const TimeEvidence& evidence, const Summary& summary, TimeConvention* found) {
  const auto unit_ns = static_cast<double>(NanosecondsPer(found->unit));
  const auto fail = [&](const std::string& why) {
    throw InputError(evidence.path,
                     "ambiguous point times: " + Describe(evidence, summary) + "; in " +
                         NameOf(found->unit) + " they are neither " +
                         "relative to the scan nor one running clock: " + why,
                     kMend);
  };
  std::vector<double> stamp_after_first_ns, stamp_after_last_ns;
  std::size_t backward = 0;
  for (std::size_t k = 0; k < evidence.samples.size(); ++k) {
    const TimeSample& sample = evidence.samples[k];
    const bool is_backward = k > 0 && sample.first <= evidence.samples[k - 1].first;
    if (is_backward && ++backward > BrokenAllowed(evidence.samples)) {
      fail("scan " + std::to_string(k) + " begins at " + Number(sample.first) +
           ", not after the one before it");
    }
    if (!sample.stamp_ns) continue;
    const auto stamp_ns = static_cast<double>(*sample.stamp_ns);
    stamp_after_first_ns.push_back(stamp_ns - sample.first * unit_ns);
    stamp_after_last_ns.push_back(stamp_ns - sample.last * unit_ns);
  }
  if (stamp_after_first_ns.empty()) {
    found->evidence += "; the times are absolute and give the stamps";
    return;
  }
  const double span_ns = summary.span * unit_ns;
  const double change_ns = RangeOfMost(stamp_after_first_ns, BrokenAllowed(evidence.samples));
  if (change_ns > std::max(span_ns, 0.5e9 * evidence.period_s)) {
    fail("their distance from the stamps changes by " + Number(change_ns * 1e-9) + " s");
  }
  const double after_first_ns = UpperMedian(stamp_after_first_ns);
  const double after_last_ns = UpperMedian(stamp_after_last_ns);
  const bool at_end = std::abs(after_last_ns) < std::abs(after_first_ns);
  if (std::abs(after_first_ns) < 1e9 || std::abs(after_last_ns) < 1e9) {
    if (found->stamp_at == StampAt::kAuto) {
      found->stamp_at = at_end ? StampAt::kEnd : StampAt::kStart;
    }
    DescribeDistance(1e-9 * after_first_ns, 1e-9 * after_last_ns, found);
    return;
  }
  const bool stamp_is_last = found->stamp_at == StampAt::kEnd;
  found->clock_offset_ns =
      static_cast<std::int64_t>(stamp_is_last ? after_last_ns : after_first_ns);
  found->evidence += "; the times are of another clock than the stamps, " +
                     Number(Seconds(found->clock_offset_ns)) +
                     " s are added so that the stamp marks the " +
                     (stamp_is_last ? "last" : "first") + " point";
}

std::string OriginText(const TimeConvention& found) {
  const std::string stamp = found.stamp_at == StampAt::kEnd ? "end" : "start";
  switch (found.origin) {
    case TimeOrigin::kSweepStart:
      return "counted from the sweep's start, stamp at its " + stamp;
    case TimeOrigin::kSweepEnd:
      return "counted from the sweep's end, stamp at its " + stamp;
    case TimeOrigin::kStamp:
      return "counted from the stamp, which lies inside the sweep";
    default:
      return "absolute";
  }
}

}  // namespace

std::int64_t TimeConvention::ZeroAfterStampNs() const {
  if (origin == TimeOrigin::kSweepStart && stamp_at == StampAt::kEnd) return -sweep_ns;
  if (origin == TimeOrigin::kSweepEnd && stamp_at == StampAt::kStart) return sweep_ns;
  return 0;
}

TimeConvention DeduceTimeConvention(const TimeEvidence& evidence, const TimeOptions& options) {
  TimeConvention found;
  if (evidence.samples.empty()) {
    found.evidence = "no point times: no scan has a point";
    return found;
  }
  const Summary summary = Summarise(evidence.samples);
  if (Float32LostTheTime(evidence, summary)) {
    throw InputError(evidence.path,
                     Describe(evidence, summary) +
                         "; a float32 of that size cannot tell the points "
                         "of a sweep apart, so their times are lost",
                     "Write the times again as float64 or relative to the scan, or set point_time "
                     "to none.");
  }
  if (summary.span == 0.0) {
    found.evidence = "no point times: field '" + evidence.field + "' is " + Number(summary.first) +
                     " for all points of a scan";
    return found;
  }
  found.field = evidence.field;
  found.unit = options.unit == TimeUnit::kAuto ? DeduceUnit(evidence, summary) : options.unit;
  found.stamp_at = options.stamp_at;
  const double span_s = summary.span * Seconds(NanosecondsPer(found.unit));
  // A scan's span misses its last firing and a gap hides its period: take the period if they agree.
  const bool period_fits = std::abs(span_s - evidence.period_s) < 0.15 * span_s;
  const double sweep_s = period_fits ? evidence.period_s : span_s;
  found.sweep_ns = Nanoseconds(std::min(sweep_s, kLongestSweep));
  found.evidence = Describe(evidence, summary) + "; in " + NameOf(found.unit) + " a sweep takes " +
                   Number(span_s) + " s";
  if (options.origin != TimeOrigin::kAuto) {
    found.origin = options.origin;
  } else if (IsRelative(evidence, found.unit, summary.span)) {
    found.origin = RelativeOrigin(summary);
  } else {
    found.origin = TimeOrigin::kAbsolute;
    CompareClocks(evidence, summary, &found);
  }
  if (found.stamp_at == StampAt::kAuto) {
    found.stamp_at = StampAt::kStart;
    if (found.origin == TimeOrigin::kSweepEnd) found.stamp_at = StampAt::kEnd;
    if (found.origin == TimeOrigin::kSweepStart) {
      found.stamp_at = JudgeStampEnd(evidence, summary.last, summary.span, &found);
    }
  }
  if (options.unit != TimeUnit::kAuto) {
    const std::string doubt = DoubtOfUnit(evidence, found.unit, span_s);
    if (!doubt.empty()) found.doubt = doubt;
  }
  found.evidence += "; " + OriginText(found);
  return found;
}

}  // namespace trajlo
