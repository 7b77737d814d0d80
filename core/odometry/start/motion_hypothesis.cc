// SPDX-License-Identifier: MIT
#include "core/odometry/start/motion_hypothesis.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/odometry/start/coarse_to_fine.h"
#include "core/odometry/window/association.h"
#include "core/odometry/window/cube.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/facing.h"
#include "factors/plane_distances.h"

namespace trajlo {
namespace {

/// This many (up to twice as many) of the points on planes that do not face a direction hold all
/// but the way along it.
constexpr std::size_t kHolding = 2000;
/// The interval has this many moments, its second half half as many.
constexpr int kMoments = 100;
/// At most this many points of a moment, or of a place, count.
constexpr int kMostVotes = 8;

int MomentOf(const RegistrationPoint& point) { return static_cast<int>(point.alpha * kMoments); }

}  // namespace

MotionHypothesis::MotionHypothesis(const SegmentCloud& interval, const Vector6d& tau,
                                   const MapPyramidOptions& map_options, ThreadPool* threads)
    : T_end_(se3::Exp(tau)) {
  MapPyramid map(map_options);
  EnterMap(interval, SE3(), T_end_, threads, &map);
  SegmentAssociation().Associate(interval, SE3(), T_end_, map, threads, &points_);
}

RegistrationNormalEquations MotionHypothesis::Linearize(const RegistrationNoise& noise) const {
  return LinearizeSegment(points_, SE3(), T_end_, noise);
}

RegistrationNormalEquations MotionHypothesis::LinearizeAlong(const Eigen::Vector3d& direction,
                                                             const RegistrationNoise& noise) const {
  std::vector<RegistrationPoint> facing, others;
  for (const RegistrationPoint& point : points_) {
    (IsFacing(point, direction) ? facing : others).push_back(point);
  }
  RegistrationNormalEquations sum = LinearizeSegment(facing, SE3(), T_end_, noise);
  const RegistrationNormalEquations held = LinearizeSegment(others, SE3(), T_end_, noise);
  const Eigen::Vector3d d = T_end_.q.conjugate() * direction;
  Matrix12d across = Matrix12d::Identity();
  across.block<3, 3>(6, 6) -= d * d.transpose();
  sum.H += across * held.H * across;
  sum.g += across * held.g;
  sum.cost += held.cost;
  return sum;
}

template <typename Function>
void MotionHypothesis::ForEachAgreeing(const Function& function) const {
  ForEachDistance(points_, SegmentMotion(SE3(), T_end_), 1,
                  [&](const RegistrationPoint& point, double distance_m) {
                    if (std::abs(distance_m) < kAgreement_m) function(point);
                  });
}

int MotionHypothesis::Agreeing() const {
  int count = 0;
  ForEachAgreeing([&](const RegistrationPoint&) { ++count; });
  return count;
}

int MotionHypothesis::AgreeingAlong(const Eigen::Vector3d& direction) const {
  int count = 0;
  ForEachAgreeing(
      [&](const RegistrationPoint& point) { count += IsFacing(point, direction) ? 1 : 0; });
  return count;
}

int MotionHypothesis::FacingAlong(const Eigen::Vector3d& direction) const {
  return static_cast<int>(
      std::count_if(points_.begin(), points_.end(),
                    [&](const RegistrationPoint& point) { return IsFacing(point, direction); }));
}

std::vector<SegmentPoint> MotionHypothesis::TellingAlong(
    const Eigen::Vector3d& direction, const std::vector<SegmentPoint>& second_half) const {
  return trajlo::TellingAlong(direction, points_, second_half, kHolding);
}

int MotionHypothesis::VotesAlong(const Eigen::Vector3d& direction, double place_m) const {
  std::map<int, int> of_moment;
  for (const RegistrationPoint& point : points_) of_moment[MomentOf(point)] = 0;
  const int moments = std::max(1, static_cast<int>(of_moment.size()));
  // The points of a motion-corrected scan are all of one moment, which has the votes of all then.
  const int most_of_moment = std::max(kMostVotes, kMostVotes * kMoments / 2 / moments);
  std::map<Cube, int> of_place;
  int votes = 0;
  ForEachAgreeing([&](const RegistrationPoint& point) {
    if (!IsFacing(point, direction)) return;
    int& moment = of_moment[MomentOf(point)];
    if (moment == most_of_moment) return;
    ++moment;
    int& place = of_place[CubeAt(point.p_body_m, place_m)];
    if (place == kMostVotes) return;
    ++place;
    ++votes;
  });
  return votes;
}

}  // namespace trajlo
