// SPDX-License-Identifier: MIT
#include "core/report/run_summary.h"

#include <algorithm>
#include <cmath>

#include "core/io/format_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// A smaller part of the input is not worth an exit code.
constexpr double kSizeableShare = 0.05;
/// What no point holds for this long may be metres off: the calmest motion that the motion prior
/// assumes (0.5 m²/s³) strays by 4.6 m.
constexpr double kLongOpen_s = 5.0;
/// And if it does so for more than this share of the time, however short each time is: people who
/// walk ahead seem to hold a corridor lengthways now and then. (With few lasers, a right walk
/// through a corridor of doors is open for half of the time.)
constexpr double kOpenShare = 2.0 / 3.0;
/// Who swings on a rope, and is found each time, is in doubt for up to a fifth of the time; who
/// follows a facade metres off, for a third.
constexpr double kDoubtfulShare = 0.25;

/// Nobody who carries a LiDAR about is slower.
constexpr double kStanding_m_s = 0.1;

std::string Seconds(double seconds) { return FormatText("%.1f s", seconds); }

}  // namespace

void RunSummary::TakePoses(const std::vector<ControlPose>& poses) {
  if (poses.empty()) return;
  const auto distance_m = [](const ControlPose& a, const ControlPose& b) {
    return (b.T_world_body.t - a.T_world_body.t).norm();
  };
  begin_ns = poses.front().t_ns;
  end_ns = poses.back().t_ns;
  distance_to_start_m = distance_m(poses.front(), poses.back());
  path_length_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i)
    path_length_m += distance_m(poses[i - 1], poses[i]);
}

std::int64_t RunSummary::NotFinite() const {
  const auto without_time = static_cast<std::int64_t>(read.points_without_time);
  // Fewer where whole scans of them were dropped.
  return std::max<std::int64_t>(points.not_finite - without_time, 0);
}

double RunSummary::ShareWithWrongTimes() const {
  if (points.received == 0) return 0.0;
  const auto dropped =
      points.too_late + points.wrong_time + static_cast<std::int64_t>(read.points_without_time);
  return static_cast<double>(dropped) / static_cast<double>(points.received);
}

std::string RunSummary::OddStamps() const {
  std::string text;
  const auto add = [&](std::int64_t count, const char* what) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(times.reordered, "put in order");
  add(times.retimed, "given the time between their neighbours (wrong stamps)");
  add(times.assumed, "given an assumed time (the stamps do not change)");
  add(times.moved, "moved with the clock, which had made a step");
  add(times.misfits, "dropped (their stamps fit nowhere)");
  add(times.repeated, "dropped (repeated)");
  add(times.stuck, "dropped (the points of a scan before with a new stamp: a driver that hangs)");
  add(times.apart, "left out (their clock does not meet that of the first LiDAR)");
  return text;
}

std::string RunSummary::Shortcomings() const {
  std::vector<std::string> parts;
  AddDamage(&parts);
  AddOddTimes(&parts);
  AddUnseenEnds(&parts);
  AddWeakTrajectory(&parts);
  for (const LidarPlace& place : rig) {
    if (place.evidence != RigEvidence::kContradicted) continue;
    parts.push_back("LiDAR " + std::to_string(place.lidar) +
                    " does not fit the others: sensor.T_body_lidar is wrong");
  }
  if (times.longest_silence_s > kSizeableShare * DataSeconds()) {
    parts.push_back("a LiDAR is silent for " + Seconds(times.longest_silence_s) +
                    ": at the beginning, at the end, or from beginning to end");
  }
  if (times.clocks_may_differ) parts.emplace_back("the clocks of the LiDARs may differ");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", and ") + part;
  return text;
}

void RunSummary::AddDamage(std::vector<std::string>* parts) const {
  if (read.file_is_cut) parts->emplace_back("a part of the file is missing or broken");
  if (read.scans_damaged > 0) {
    parts->push_back(CountOf(read.scans_damaged, "scan is", "scans are") + " damaged");
  }
  if (read.scans_skipped > 0) {
    parts->push_back(CountOf(read.scans_skipped, "scan") + " could not be read at all");
  }
  if (read.scans_left_out > 0) {
    parts->push_back(CountOf(read.scans_left_out, "scan is", "scans are") +
                     " left out, as the others are of another format");
  }
  for (const std::string& topic : read.topics_without_messages) {
    parts->push_back("topic " + topic + " has no message");
  }
  if (read.MissesPoints()) {
    parts->push_back(CountOf(read.points_undeclared, "point") +
                     " behind those that the headers of the scans declare were not read");
  }
  if (ShareWithWrongTimes() > kSizeableShare) {
    parts->push_back(std::to_string(std::lround(100.0 * ShareWithWrongTimes())) +
                     " % of the points were dropped because of their times (" +
                     std::to_string(points.too_late) + " too late, " +
                     std::to_string(points.wrong_time) + " of wrong stamps, " +
                     std::to_string(read.points_without_time) + " impossible, as NaN is)");
  }
}

void RunSummary::AddOddTimes(std::vector<std::string>* parts) const {
  const std::int64_t assumed = times.assumed + times.retimed + times.moved;
  const std::string of_scans = "of " + std::to_string(times.scans) + " scans ";
  if (IsSizeable(assumed)) {
    parts->push_back("the times of " + std::to_string(assumed) + " " + of_scans +
                     "are not those of their stamps");
  }
  if (IsSizeable(times.odd_point_times)) {
    parts->push_back(of_scans + "some have a single time for all points, or none");
  }
  if (IsSizeable(times.stuck)) {
    parts->push_back(std::to_string(times.stuck) + " " + of_scans +
                     "have the points of a scan before");
  }
  if (IsSizeable(times.exchanged)) {
    parts->push_back(std::to_string(times.exchanged) + " " + of_scans +
                     "may be out of order, by what they show");
  }
}

void RunSummary::AddUnseenEnds(std::vector<std::string>* parts) const {
  const std::string of_scans = " of " + std::to_string(times.scans) + " scans ";
  if (IsSizeable(times.before_first_pose)) {
    parts->push_back("the first " + std::to_string(times.before_first_pose) + of_scans +
                     "show nothing, or too little, of the world" +
                     (times.Dropped() > 0 ? ", or were dropped for their stamps" : "") +
                     ": the trajectory begins after them" + OutOfRange());
  }
  if (IsSizeable(times.Unseen())) {
    parts->push_back("the last " + std::to_string(times.Unseen()) + of_scans +
                     "have no point that can be used: the trajectory ends before them" +
                     OutOfRange());
  }
  if (times.doubtful_begin_s > kSizeableShare * DataSeconds()) {
    parts->push_back("by its stamp, the first scan comes " + Seconds(times.doubtful_begin_s) +
                     " before the next; nothing confirms that, and it was left out");
  }
  if (times.doubtful_end_s > kSizeableShare * DataSeconds()) {
    parts->push_back("by its stamp, the last scan comes " + Seconds(times.doubtful_end_s) +
                     " after the one before; nothing confirms that, and it was left out");
  }
}

/// Why scans may show nothing: the LiDAR is farther from all things than it was said to see.
std::string RunSummary::OutOfRange() const {
  if (points.received == 0) return "";
  const double share = static_cast<double>(points.too_far) / static_cast<double>(points.received);
  if (share <= kSizeableShare) return "";
  return FormatText(" (%.0f %% of all points are beyond sensor.max_range_m)", 100.0 * share);
}

void RunSummary::AddWeakTrajectory(std::vector<std::string>* parts) const {
  if (too_short) {
    parts->emplace_back(
        "the recording is too short for a window (expert.initialization.first_interval_s): nothing "
        "confirms how the body moved");
  }
  const double unmeasured_s = flags.totals().at("gap").seconds;
  if (unmeasured_s > kSizeableShare * flags.seconds()) {
    parts->push_back(
        FormatText("for %.2f of %.2f s nothing was measured, or the place was not found",
                   unmeasured_s, flags.seconds()));
  }
  if (points.sight_lines.AreCrossed() && path_length_m < kStanding_m_s * DataSeconds()) {
    parts->push_back(
        FormatText("the body seems to stand still, but in %.0f %% of all directions scans show one "
                   "thing behind another",
                   100.0 * points.sight_lines.Share()) +
        ": are the points in the LiDAR's own frame? Clouds that were registered already are not");
  }
  const FlaggedPoses jump = flags.totals().at("jump"), open = flags.totals().at("degenerate"),
                     lone = flags.totals().at("lone_object");
  if (too_short) return;  // It is said above that nothing confirms the poses.
  if (flags.any().seconds > (1.0 - kSizeableShare) * flags.seconds()) {
    parts->push_back(
        FormatText("%.2f of %.2f s have a flag (flags.csv)", flags.any().seconds, flags.seconds()) +
        ": almost no pose can be trusted");
  } else if (open.longest_s > kLongOpen_s) {
    parts->push_back(
        FormatText("for %.2f s on end the points left a direction open (flag degenerate)",
                   open.longest_s) +
        ": nothing tells how the body moved along or about it");
  } else if (open.seconds > kOpenShare * flags.seconds()) {
    parts->push_back(FormatText(
        "for %.2f of %.2f s the points left a direction open (flag degenerate): nothing tells how "
        "the body moved along or about it",
        open.seconds, flags.seconds()));
  } else if (lone.seconds > kDoubtfulShare * flags.seconds()) {
    parts->push_back(
        FormatText("for %.2f of %.2f s one object alone holds a direction, and the rest of the "
                   "world contradicts it (flag lone_object)",
                   lone.seconds, flags.seconds()) +
        ": it may move along with the body, as a truck ahead does");
  } else if (jump.seconds > kDoubtfulShare * flags.seconds()) {
    parts->push_back(
        FormatText("for %.2f of %.2f s poses jump further than a body can move, or have been "
                   "in doubt since then (flag jump)",
                   jump.seconds, flags.seconds()));
  }
}

bool RunSummary::IsSizeable(std::int64_t scans) const {
  return static_cast<double>(scans) > kSizeableShare * static_cast<double>(times.scans);
}

}  // namespace trajlo
