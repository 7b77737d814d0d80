// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trajlo {

/// What became of the scans whose times did not simply go on, by reason.
struct TimeReport {
  std::int64_t scans = 0;  ///< All that came.

  // Handed on.
  std::int64_t reordered = 0;  ///< Before scans that came earlier.
  std::int64_t retimed = 0;    ///< At the free place between their neighbours.
  std::int64_t assumed = 0;    ///< A period after the scan before, as the stamps stand still.
  std::int64_t moved = 0;      ///< With the clock, which had made a step.
  // Dropped.
  std::int64_t misfits = 0;   ///< The stamp fits nowhere.
  std::int64_t repeated = 0;  ///< The place of the stamp is taken.
  std::int64_t stuck = 0;     ///< The points are those of a scan before, the stamp is new.
  std::int64_t apart = 0;     ///< Of a LiDAR whose clock does not meet that of the first.

  std::int64_t clock_steps = 0;  ///< Lasting ones: the times on one side are moved.
  std::int64_t points = 0;       ///< Of the dropped scans, and those far from their scan's time.
  std::int64_t odd_point_times = 0;  ///< Scans with one time for all points where others have more.
  std::int64_t exchanged = 0;  ///< Of scans that were handed on: seem to have each other's points.
  std::int64_t before_first_pose = 0;  ///< Scans before the one in which the trajectory begins.
  std::int64_t until_last_point = 0;   ///< Scans up to the last one with a point of use.

  /// How much earlier the first scan is than the next, if it was dropped, and
  double doubtful_begin_s = 0.0;
  /// how much later the last scan is than the one before, if it was dropped: nothing confirms that.
  double doubtful_end_s = 0.0;
  /// One LiDAR begins later than another, and ends as much later; or their clocks run apart.
  bool clocks_may_differ = false;

  /// For how long one LiDAR is silent at the begin or at the end, or from begin to end, while
  /// another one is heard.
  double longest_silence_s = 0.0;

  /// What a user should know, a sentence each.
  std::vector<std::string> remarks;

  /// Behind the last pose: of these no point could be used.
  std::int64_t Unseen() const { return scans - until_last_point; }
  std::int64_t Dropped() const { return misfits + repeated + stuck + apart; }
};

}  // namespace trajlo
