// SPDX-License-Identifier: MIT
#include "core/odometry/start/return_search.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/health/support.h"
#include "core/odometry/segments/join_segments.h"
#include "core/odometry/start/initial_motion.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Looks are farther apart the longer the search lasts: by this share of its time.
constexpr double kPatience = 0.25;
/// The region holds rest and 1.5 times the way of the last velocity: a middle and a half of 0.75.
constexpr double kMiddle = 0.75;
/// The scene's uncertainty at three standard deviations.
constexpr double kMinRadius_m = 0.5;
/// Nor is the body taken to accelerate less than this, however quiet it was before.
constexpr double kAcceleration_m_s2 = 2.0;
constexpr double kTurnAcceleration_rad_s2 = 2.0;
/// What a look may cost.
constexpr double kMaxRadius_m = 40.0;
constexpr double kMinTurn_rad = 0.1;
/// A velocity says nothing after this time.
constexpr double kLongestPrediction_s = 5.0;
/// How far the motion of a sweep may be from a constant twist: points must agree to twice that.
constexpr double kBend_m = 0.06;
/// But a sweep has this many segments.
constexpr double kFewestSegments = 3.0;
/// Attitudes nearer than this are one.
constexpr double kSameTilt_rad = 0.05;

/// How far a body gets off its course: three standard deviations of white noise on acceleration, or
/// a steady acceleration.
double Reach(double density, double acceleration, double unseen_s) {
  return std::max(3.0 * UnseenSigma(density, unseen_s), 0.5 * acceleration * unseen_s * unseen_s);
}

}  // namespace

void ReturnSearch::Add(SegmentCloud segment) {
  if (segment.is_gap) segments_.clear();
  if (segment.is_gap || (segments_.empty() && segment.map_points.empty())) return;
  if (!segment.map_points.empty()) searched_s_ += segment.Duration_s();
  since_look_s_ += segment.Duration_s();
  if (segment.is_instant) segments_.clear();
  segments_.push_back(std::move(segment));
  const auto longest_ns = Nanoseconds(Longest_s());
  while (segments_.size() > 1 &&
         (segments_.back().end_ns - segments_.front().begin_ns > longest_ns ||
          segments_.front().map_points.empty())) {
    segments_.erase(segments_.begin());
  }
}

/// White noise on acceleration takes a body off the straight way between two of its places, T
/// apart, by a variance of q t² (T - t)² / (3 T) at t; the mean of that is q T³ / 90.
double ReturnSearch::Longest_s() const {
  const double twist_s = std::cbrt(90.0 * kBend_m * kBend_m / last_.density[0]);
  return std::min(std::max(twist_s, kFewestSegments * options_.segmenter.interval_s),
                  options_.initialization.first_interval_s);
}

bool ReturnSearch::IsDue() const {
  if (segments_.empty()) return false;
  if (segments_.back().is_instant) return since_look_s_ >= kPatience * searched_s_;
  const double sweep_s = Seconds(segments_.back().end_ns - segments_.front().begin_ns);
  const double enough_s = Longest_s() - options_.segmenter.interval_s;
  return sweep_s >= enough_s && since_look_s_ >= std::max(enough_s, kPatience * searched_s_);
}

SE3 ReturnSearch::Predict(std::int64_t t_ns) const {
  const double unseen_s = std::min(Seconds(t_ns - last_.t_ns), kLongestPrediction_s);
  return last_.T_world_body * se3::Exp(unseen_s * last_.velocity);
}

SearchRegion ReturnSearch::Region(std::int64_t t_ns) const {
  const double unseen_s = Seconds(t_ns - last_.supported_until_ns);
  const double moving_s = std::min(Seconds(t_ns - last_.t_ns), kLongestPrediction_s);
  const double moved_s = std::min(unseen_s, kLongestPrediction_s);
  SearchRegion region;
  region.turn_axis_world = last_.turn_axis_world;
  region.center_world = (last_.T_world_body * se3::Exp(kMiddle * moving_s * last_.velocity)).t;
  const double way_m = moved_s * last_.velocity.head<3>().norm();
  const double reach_m = Reach(last_.density[0], kAcceleration_m_s2, unseen_s) + kMinRadius_m;
  region.radius_m = std::min(kMiddle * way_m + reach_m, kMaxRadius_m);

  const Eigen::Vector3d turn_rate_world = last_.T_world_body.q * last_.velocity.tail<3>();
  region.mean_turn_rad = kMiddle * moving_s * turn_rate_world.dot(region.turn_axis_world);
  const double turn_rad = kMiddle * moved_s * last_.velocity.tail<3>().norm();
  const double turn_reach_rad =
      Reach(last_.density[3], kTurnAcceleration_rad_s2, unseen_s) + kMinTurn_rad;
  region.max_turn_rad = std::min(turn_rad + turn_reach_rad, M_PI);
  region.q_world_body = {last_.T_world_body.q};
  if (last_.level_world_body.angularDistance(last_.T_world_body.q) > kSameTilt_rad) {
    region.q_world_body.push_back(last_.level_world_body);
  }
  return region;
}

ReturnSweep ReturnSearch::Look(const MapPyramid& map, ThreadPool* threads) {
  since_look_s_ = 0.0;
  ReturnSweep sweep;
  sweep.cloud = JoinSegments(segments_);
  Vector6d tau = Vector6d::Zero();
  if (sweep.cloud.is_instant) {
    sweep.cloud.begin_ns = sweep.cloud.end_ns;
  } else {
    tau = sweep.cloud.Duration_s() * MotionOfFirstInterval(sweep.cloud, options_, threads).velocity;
  }
  sweep.found = Relocalize(sweep.cloud, tau, map, Region(sweep.cloud.begin_ns),
                           options_.registration, threads);
  return sweep;
}

}  // namespace trajlo
