// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/odometry/odometry_options.h"
#include "core/odometry/start/relocalization.h"

namespace trajlo {

/// What was known when the search began.
struct LastSeen {
  /// When the points ended; from there on the motion is carried on.
  std::int64_t supported_until_ns = 0;
  std::int64_t t_ns = 0;  ///< Of the pose.
  SE3 T_world_body;
  /// The attitude without the tilt that it has more than the mean, see MeanAttitude.
  Eigen::Quaterniond level_world_body = Eigen::Quaterniond::Identity();
  Vector6d velocity = Vector6d::Zero();  ///< [rho; theta] per second, body frame.
  Vector6d density = Vector6d::Zero();   ///< Of the acceleration, see MotionPrior.
  Eigen::Vector3d turn_axis_world = Eigen::Vector3d::UnitZ();  ///< See SearchRegion.
};

/// The newest points after a time unseen, and where they were measured, if that was found.
struct ReturnSweep {
  SegmentCloud cloud;
  std::optional<SweepMotion> found;
};

/// The state of an odometry that does not know where it is, after a pause or while its LiDARs see
/// nothing: it keeps the newest segments, and looks for them in the map from time to time. A return
/// is a start of which the place is sought: the motion within the sweep is found as that of a
/// recording's first interval, then the sweep is looked for wherever the body can be.
class ReturnSearch {
 public:
  /// When this much data has come and the place is not found, the estimator is lost.
  static constexpr double kMaxSearch_s = 5.0;

  /// `options` must outlive it.
  ReturnSearch(const LastSeen& last, const OdometryOptions& options)
      : last_(last), options_(options) {}

  const LastSeen& last() const { return last_; }
  /// A segment, or a gap: what came before one is of no use.
  void Add(SegmentCloud segment);
  /// Whether enough has come since the last look.
  bool IsDue() const;
  /// Whether it has looked long enough (kMaxSearch_s of data).
  bool IsHopeless() const { return searched_s_ >= kMaxSearch_s; }
  bool HasPoints() const { return !segments_.empty(); }

  ReturnSweep Look(const MapPyramid& map, ThreadPool* threads);
  std::vector<SegmentCloud> TakeSegments() { return std::move(segments_); }
  /// Where the body is if it went on as it did, for as long as that can be said.
  SE3 Predict(std::int64_t t_ns) const;

 private:
  /// The newest segments over longer are no sweep.
  double Longest_s() const;
  SearchRegion Region(std::int64_t t_ns) const;

  LastSeen last_;
  const OdometryOptions& options_;
  std::vector<SegmentCloud> segments_;  ///< In a row; the first one has points.
  double searched_s_ = 0.0;             ///< Time with points since then.
  double since_look_s_ = 0.0;
};

}  // namespace trajlo
