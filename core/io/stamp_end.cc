// SPDX-License-Identifier: MIT
#include "core/io/stamp_end.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/io/format_text.h"
#include "core/scans/median.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Sweeps that are cut short (a LiDAR that starts, a driver that waits) join their neighbours by
/// one convention only: the next stamp comes as soon after a stamp at the start, the one before is
/// as near to a stamp at the end.
StampAt JudgeByCutSweeps(const TimeEvidence& evidence, double last_s, double span_s,
                         double unit_s) {
  constexpr double kSame = 0.03, kCut = 0.1;  // Of a sweep.
  const std::vector<TimeSample>& samples = evidence.samples;
  const auto step_matches = [&](std::size_t k, double sweep_s) {  // From stamp k to stamp k + 1.
    if (k + 1 >= samples.size() || !samples[k].stamp_ns || !samples[k + 1].stamp_ns) return false;
    const double step_s = Seconds(*samples[k + 1].stamp_ns - *samples[k].stamp_ns);
    return std::abs(step_s - sweep_s) < kSame * span_s;
  };
  int starts = 0, ends = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double sweep_s = samples[k].last * unit_s;
    if (std::abs(sweep_s - last_s) < kCut * span_s) continue;
    const bool start = step_matches(k, sweep_s);
    const bool end = k > 0 && step_matches(k - 1, sweep_s);
    starts += start && !end ? 1 : 0;
    ends += end && !start ? 1 : 0;
  }
  if ((starts > 0) == (ends > 0)) return StampAt::kAuto;
  return starts > 0 ? StampAt::kStart : StampAt::kEnd;
}

void Doubt(const std::string& why, TimeConvention* found) {
  found->doubt = "stamps are taken for the start of the sweep, but " + why +
                 "; if they mark its end, all times are " +
                 FormatText("%.4g s", Seconds(found->sweep_ns)) +
                 " too late; set input.stamp_at=end";
}

bool DoStampsStandStill(const std::vector<TimeSample>& samples) {
  return samples.size() > 1 &&
         std::all_of(samples.begin(), samples.end(), [&](const TimeSample& sample) {
           return sample.stamp_ns == samples.front().stamp_ns;
         });
}

/// Which end of the sweep the stamps mark, by the time of recording: the last point was measured
/// before, so a message recorded less than a sweep after its stamp has the stamp of its end.
StampAt JudgeByRecording(const TimeEvidence& evidence, TimeConvention* found) {
  constexpr double kCopy_s = 20e-6;  // No recorder is so fast.
  std::vector<double> delays_s;
  for (const TimeSample& sample : evidence.samples) {
    if (!sample.stamp_ns || !sample.recorded_ns) continue;
    delays_s.push_back(Seconds(*sample.recorded_ns - *sample.stamp_ns));
  }
  if (delays_s.empty()) return StampAt::kAuto;
  const double delay_s = UpperMedian(delays_s);
  const double sweep_s = Seconds(found->sweep_ns);
  if (std::abs(delay_s) < kCopy_s) {
    Doubt("the times of recording are copies of them, and nothing else tells", found);
    return StampAt::kAuto;
  }
  if (DoStampsStandStill(evidence.samples)) {
    found->evidence += "; the stamps do not move";
    return StampAt::kAuto;
  }
  found->evidence += "; messages were recorded " + BeforeOrAfter(delay_s) + " their stamp";
  if (delay_s < -0.1 * sweep_s || delay_s > 10.0 * sweep_s) {
    Doubt("the recorder's clock differs: it is " + FormatText("%.4g s ", std::abs(delay_s)) +
              (delay_s < 0.0 ? "behind" : "ahead") + ", and nothing else tells",
          found);
    found->evidence += ", so the clocks differ";
    return StampAt::kAuto;
  }
  return delay_s < 0.8 * sweep_s ? StampAt::kEnd : StampAt::kStart;
}

}  // namespace

std::string BeforeOrAfter(double after_s) {
  return FormatText("%.4g s ", std::abs(after_s)) + (after_s < 0.0 ? "before" : "after");
}

StampAt JudgeStampEnd(const TimeEvidence& evidence, double last, double span,
                      TimeConvention* found) {
  const double unit_s = Seconds(NanosecondsPer(found->unit));
  const StampAt by_sweeps = JudgeByCutSweeps(evidence, last * unit_s, span * unit_s, unit_s);
  if (by_sweeps != StampAt::kAuto) {
    found->evidence += "; so sweeps that are cut short join their neighbours";
    return by_sweeps;
  }
  const StampAt by_recording = JudgeByRecording(evidence, found);
  if (by_recording != StampAt::kAuto) return by_recording;
  found->evidence += "; the stamp is assumed to mark the start (input.stamp_at)";
  found->stamp_at_is_assumed = true;
  return StampAt::kStart;
}

}  // namespace trajlo
