// SPDX-License-Identifier: MIT
#include "core/odometry/first_speed.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "core/odometry/first_poses.h"
#include "core/odometry/segments/choose_evenly.h"
#include "core/odometry/start/beginning.h"
#include "core/odometry/start/coarse_to_fine.h"
#include "core/odometry/tracker.h"
#include "core/odometry/window/cube.h"
#include "core/odometry/window/facing.h"

namespace trajlo {
namespace {

/// Trackers begin at these speeds, forward and backward.
constexpr double kFastest_m_s = 50.0;
constexpr double kStep_m_s = 5.0;
/// Only those with the most places after this time follow to the end, again from the beginning, at
/// the speeds that they have come to.
constexpr double kFirstRound_s = 0.9;
constexpr std::size_t kFinalists = 3;
/// Trackers whose speeds differ by less have found the same.
constexpr double kSame_m_s = 2.5;
/// No body changes its speed by more in the time of the search.
constexpr double kMostChange_m_s = 8.0;
/// The edge of a place: about the back of a car.
constexpr double kPlace_m = 3.0;
/// A place was seen again if this many points of later segments lie on its planes.
constexpr int kSeenAgain = 4;
/// No traffic has so many places.
constexpr int kLargeWorld = 40;
/// By which a speed must have more places than others, in their standard deviations.
constexpr double kClearDeviations = 2.0;
/// Of what faces the direction, it must have this share of the agreement that the speed as found
/// has: 0.7 where that was the speed of traffic, and 0.25 and 0.44 where the body was at rest
/// before a row of houses.
constexpr double kToBelieve = 0.6;
/// Of a segment, at most this many points that may tell the speed are followed and enter the map,
/// and about this many of the others, to hold all but the way along the direction. Those of a road
/// are too many, and dear.
constexpr std::size_t kTelling = 1200, kTellingInMap = 2500;
constexpr std::size_t kHolding = 400, kHoldingInMap = 1000;
/// Map points around those that do not tell the speed do not tell it, either: in cubes of this
/// edge.
constexpr double kAround_m = 0.4;

/// A tracker that began with some speed along the direction, and what it saw again.
class Follower {
 public:
  Follower(const std::vector<SegmentCloud>& first, Vector6d velocity,
           const Eigen::Vector3d& direction, double speed_m_s, const OdometryOptions& options,
           const WindowSolverFactory& make_solver, ThreadPool* threads)
      : direction_(direction),
        begin_m_s_(speed_m_s),
        speed_m_s_(speed_m_s),
        tracker_(options, make_solver, threads) {
    velocity.head<3>() += (speed_m_s - velocity.head<3>().dot(direction)) * direction;
    tracker_.StayLost();
    tracker_.BeginMap(first, ConstantTwist(first, velocity), velocity, 0);
  }

  /// Returns the points of the segment that lie on planes which do not face the direction.
  std::vector<RegistrationPoint> Follow(SegmentCloud segment) {
    std::optional<Window> window;
    is_lost_ = is_lost_ || !tracker_.Step(&segment, &window);
    if (is_lost_) return {};
    std::vector<RegistrationPoint> along;
    const Segment& newest = window->segments.back();
    const SegmentMotion motion = window->Motion(window->size() - 1);
    for (const RegistrationPoint& point : newest.points) {
      const Eigen::Vector3d p_world = motion.ToWorld(point.alpha, point.p_body_m);
      const bool agrees = std::abs(point.DistanceToPlane(p_world)) < kAgreement_m;
      if (IsFacing(point, direction_)) {
        ++facing_;
        agreeing_ += agrees ? 1 : 0;
        if (agrees && ++seen_[CubeAt(p_world, kPlace_m)] == kSeenAgain) ++places_;
      } else if (agrees) {
        along.push_back(point);
      }
    }
    speed_m_s_ = direction_.dot(motion.R_begin * window->EndVelocity().head<3>());
    return along;
  }

  /// How many were seen again; none by a tracker that slid, which sees the same things at many.
  int places() const {
    const bool has_slid = std::abs(speed_m_s_ - begin_m_s_) > kMostChange_m_s;
    return is_lost_ || has_slid ? 0 : places_;
  }
  /// Of the points whose planes face the direction, the share that lies on them.
  double AgreeingShare() const { return agreeing_ / std::max(facing_, 1.0); }
  /// Now.
  double speed_m_s() const { return speed_m_s_; }

 private:
  const Eigen::Vector3d direction_;
  const double begin_m_s_;
  double speed_m_s_;
  bool is_lost_ = false;
  double facing_ = 0.0, agreeing_ = 0.0;
  std::map<Cube, int> seen_;
  int places_ = 0;
  Tracker tracker_;
};

using Followers = std::vector<std::unique_ptr<Follower>>;

/// A segment without most of what says nothing about the way along the direction: `along`, of its
/// points, and the map points around them.
SegmentCloud Telling(SegmentCloud segment, const std::vector<RegistrationPoint>& along,
                     const Eigen::Vector3d& direction) {
  std::set<Cube> cubes;
  for (const RegistrationPoint& point : along) cubes.insert(CubeAt(point.p_body_m, kAround_m));
  std::vector<SegmentPoint> telling, others;
  for (const SegmentPoint& point : segment.map_points) {
    const bool is_around = cubes.count(CubeAt(point.p_body_m.cast<double>(), kAround_m)) > 0;
    (is_around ? others : telling).push_back(point);
  }
  segment.map_points = ChooseEvenly(telling, kTellingInMap);
  others = ChooseEvenly(others, kHoldingInMap);
  segment.map_points.insert(segment.map_points.end(), others.begin(), others.end());
  segment.registration_points =
      ChooseEvenly(TellingAlong(direction, along, segment.registration_points, kHolding), kTelling);
  return segment;
}

bool IsSameSpeed(double a_m_s, double b_m_s) { return std::abs(a_m_s - b_m_s) < kSame_m_s; }

std::vector<double> SpeedsToTry() {
  std::vector<double> speeds_m_s;
  for (double v = -kFastest_m_s; v <= kFastest_m_s; v += kStep_m_s) speeds_m_s.push_back(v);
  return speeds_m_s;
}

/// The speeds of those with the most places, each once.
std::vector<double> BestSpeeds(Followers followers) {
  std::stable_sort(followers.begin(), followers.end(),
                   [](const auto& a, const auto& b) { return a->places() > b->places(); });
  std::vector<double> speeds_m_s;
  for (const auto& follower : followers) {
    const bool is_new = std::none_of(speeds_m_s.begin(), speeds_m_s.end(), [&](double other) {
      return IsSameSpeed(other, follower->speed_m_s());
    });
    if (is_new && speeds_m_s.size() < kFinalists) speeds_m_s.push_back(follower->speed_m_s());
  }
  return speeds_m_s;
}

/// Which of those that agree well enough has the most places, if these are clearly more than those
/// of any that found another speed, and it is not the speed that `as_found` comes to.
std::optional<std::size_t> ClearlyAnother(const Followers& finalists, const Follower& as_found) {
  const double to_believe = kToBelieve * as_found.AgreeingShare();
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < finalists.size(); ++i) {
    if (finalists[i]->AgreeingShare() < to_believe) continue;
    if (!best || finalists[i]->places() > finalists[*best]->places()) best = i;
  }
  if (!best) return std::nullopt;
  const double end_m_s = finalists[*best]->speed_m_s();
  if (IsSameSpeed(as_found.speed_m_s(), end_m_s)) return std::nullopt;
  int elsewhere = as_found.places();
  for (const auto& follower : finalists) {
    if (IsSameSpeed(follower->speed_m_s(), end_m_s)) continue;
    elsewhere = std::max(elsewhere, follower->places());
  }
  const double clearly = elsewhere + kClearDeviations * std::sqrt(elsewhere);
  return finalists[*best]->places() > clearly ? best : std::nullopt;
}

}  // namespace

FirstMotion FindFirstSpeed(const std::vector<SegmentCloud>& segments, std::size_t in_interval,
                           const FirstMotion& found, const OdometryOptions& options,
                           const WindowSolverFactory& make_solver, ThreadPool* threads) {
  const Eigen::Vector3d& direction = *found.open_direction;
  const double found_m_s = found.velocity.head<3>().dot(direction);
  const auto middle = segments.begin() + static_cast<std::ptrdiff_t>(in_interval);
  const std::vector<SegmentCloud> first(segments.begin(), middle);

  // The one that begins as found sees all points; the others, those that it leaves to tell more.
  Follower as_found(first, found.velocity, direction, found_m_s, options, make_solver, threads);
  std::vector<SegmentCloud> telling;
  for (auto segment = middle; segment != segments.end(); ++segment) {
    telling.push_back(Telling(*segment, as_found.Follow(*segment), direction));
  }
  if (as_found.places() >= kLargeWorld) return found;

  ThreadPool one(1);
  const auto follow = [&](const std::vector<double>& speeds_m_s, double duration_s) {
    const std::int64_t end_ns = first.back().end_ns + Nanoseconds(duration_s);
    Followers followers(speeds_m_s.size());
    threads->ParallelFor(followers.size(), [&](std::size_t i) {
      followers[i] = std::make_unique<Follower>(first, found.velocity, direction, speeds_m_s[i],
                                                options, make_solver, &one);
      for (const SegmentCloud& segment : telling) {
        if (segment.end_ns <= end_ns) followers[i]->Follow(segment);
      }
    });
    return followers;
  };
  const std::vector<double> speeds_m_s = BestSpeeds(follow(SpeedsToTry(), kFirstRound_s));
  const auto best = ClearlyAnother(follow(speeds_m_s, kSpeedSearch_s), as_found);
  if (!best) return found;
  FirstMotion motion = found;
  motion.velocity.head<3>() += (speeds_m_s[*best] - found_m_s) * direction;
  motion.is_at_rest = false;
  motion.is_steady = true;
  return motion;
}

}  // namespace trajlo
