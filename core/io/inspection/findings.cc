// SPDX-License-Identifier: MIT
#include "core/io/inspection/findings.h"

#include <algorithm>
#include <cmath>

#include "core/io/format_text.h"
#include "core/io/messages/fixed_frame.h"
#include "core/io/scan_stamps.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Sweeps meet within this share of a sweep; a limited field of view leaves longer pauses.
constexpr double kOverlapShare = 0.1;
constexpr double kPauseShare = 0.5;
constexpr std::size_t kFewReturns = 500;
constexpr double kMedianOfNoLidar_m = 300.0;

void JudgeTimes(const CloudInspection& cloud, std::vector<std::string>* findings) {
  if (!cloud.time_problem.empty()) {
    findings->push_back("trajlo_run will refuse: " + cloud.time_problem);
  } else if (const auto doubt = DoubtOfStampUnit(cloud.stamps.period_s); !doubt.empty()) {
    findings->push_back(doubt);
  }
  if (!cloud.convention.doubt.empty()) findings->push_back(cloud.convention.doubt);
  if (cloud.stamp_is_recorded) {
    findings->push_back(
        "the stamps are zero: times of recording stand for them, with the recorder's jitter");
  }
  if (cloud.stamp_is_assumed) {
    findings->push_back(
        "nothing gives the scans' stamps: an even count is assumed "
        "(input.stamps_file, input.scan_period_s)");
  }
  if (!cloud.sweeps) return;
  const SweepSummary& sweeps = *cloud.sweeps;
  if (sweeps.pause_s < -kOverlapShare * sweeps.span_s) {
    findings->push_back(
        FormatText("sweeps overlap by %.4g s: unit or origin of the times may be wrong "
                   "(input.time_unit, input.time_origin)",
                   -sweeps.pause_s));
  } else if (sweeps.pause_s > kPauseShare * sweeps.span_s) {
    findings->push_back(FormatText("sweeps are %.4g s long, with pauses of %.4g s between them",
                                   sweeps.span_s, sweeps.pause_s));
  }
  if (sweeps.points_without_time > 0) {
    findings->push_back("dropped: " + CountOf(sweeps.points_without_time, "point") +
                        " with impossible times");
  }
}

void JudgeStamps(const StampSummary& stamps, std::vector<std::string>* findings) {
  if (!stamps.gaps.empty()) {
    const auto longest = std::max_element(
        stamps.gaps.begin(), stamps.gaps.end(),
        [](const StampGap& a, const StampGap& b) { return a.length_ns < b.length_ns; });
    findings->push_back(
        CountOf(stamps.gaps.size(), "gap") + ", about " +
        CountOf(stamps.missing, "scan is", "scans are") +
        FormatText(" missing; the longest, %.4g s, is after ", Seconds(longest->length_ns)) +
        FormatSeconds(longest->after_ns) + " s");
  }
  if (stamps.duplicates > 0) {
    findings->push_back(CountOf(stamps.duplicates, "stamp repeats", "stamps repeat") +
                        " the one before, the first at " +
                        FormatSeconds(*stamps.first_duplicate_ns) + " s");
  }
  if (stamps.steps_back > 0) {
    findings->push_back(
        CountOf(stamps.steps_back, "stamp steps", "stamps step") +
        FormatText(" back by up to %.4g s, the first at ", stamps.largest_step_back_s) +
        FormatSeconds(*stamps.first_step_back_ns) + " s");
  }
  if (stamps.jitter_s > 0.05 * stamps.period_s) {
    findings->push_back(FormatText("the stamps jitter by %.2g s (root mean square), %.2g s at most",
                                   stamps.jitter_s, stamps.largest_deviation_s));
  }
}

void JudgePoints(const CloudInspection& cloud, std::vector<std::string>* findings) {
  const PointSummary& points = cloud.points;
  if (cloud.messages_unreadable > 0) {
    findings->push_back(CountOf(cloud.messages_unreadable, "message") +
                        " cannot be read: " + cloud.first_unreadable);
  }
  if (cloud.messages_damaged > 0) {
    findings->push_back(CountOf(cloud.messages_damaged, "message is", "messages are") +
                        " damaged, the first: " + cloud.first_damage);
  }
  if (points.empty_messages > 0) {
    findings->push_back(CountOf(points.empty_messages, "message has", "messages have") +
                        " no points");
  }
  const std::size_t readable = cloud.messages_read - cloud.messages_unreadable;
  const bool has_few = readable > 0 && points.Returns() < kFewReturns * readable;
  if (has_few && points.Returns() == 0) {
    findings->push_back("no point is a return: trajlo_run will refuse this LiDAR alone");
  } else if (has_few) {
    findings->push_back(
        FormatText("only %zu returns a message: little to register", points.Returns() / readable));
  }
  if (points.range_median_m > kMedianOfNoLidar_m) {
    findings->push_back(
        FormatText("half of the points are farther than %.0f m: the coordinates may be in "
                   "millimetres, and must be in metres",
                   points.range_median_m));
  }
  if (cloud.frame_ids.size() > 1) {
    findings->push_back(FormatText("%zu frame ids on one topic", cloud.frame_ids.size()));
  }
  for (const std::string& frame_id : cloud.frame_ids) {
    if (const auto doubt = DoubtOfFrame(frame_id); !doubt.empty()) findings->push_back(doubt);
  }
}

}  // namespace

std::vector<std::string> FindingsOf(const CloudInspection& cloud) {
  std::vector<std::string> findings;
  JudgeTimes(cloud, &findings);
  JudgeStamps(cloud.stamps, &findings);
  JudgePoints(cloud, &findings);
  return findings;
}

}  // namespace trajlo
