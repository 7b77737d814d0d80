// SPDX-License-Identifier: MIT
#include "core/odometry/start/initial_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/odometry/segments/voxel_filter.h"
#include "core/odometry/start/coarse_to_fine.h"
#include "core/odometry/start/motion_hypothesis.h"
#include "core/scans/median.h"

namespace trajlo {
namespace {

constexpr int kRounds = 20;
/// From here on steps are halved: the choice of neighbours makes the last centimetre flip to and
/// fro.
constexpr int kDampedFrom = 8;
/// The second half has one point in a cell of this size, and no fewer: few may face a direction
/// that is held weakly.
constexpr double kSpacing_m = 0.4;
/// A start faster than this is not expected; it only holds directions that nobody measures.
constexpr double kPriorSigma_m = 10.0;
constexpr double kPriorSigma_rad = 2.0;
/// A motion is believed if it brings this many times as many points onto planes as standing still
/// does ...
constexpr double kMinGain = 1.15;
/// ... or simply more, where it is longer than this: at rest the estimate is off by centimetres,
/// and a street explains nearly as many points at any speed. What counts is all points, or those
/// that face the direction which is held weakly.
constexpr double kClearMotion_m = 0.3;

/// A motion that is shorter over the first interval blurs nothing.
constexpr double kAtRest_m = 0.1;
constexpr double kAtRest_rad = 0.03;
/// Of the points that have a plane, this share is on it where a constant twist explains the
/// interval: 0.8 to 0.9 at rest, 0.7 to 0.8 in a street and on a steady walk, 0.1 to 0.6 in a
/// flight with quick turns, on a motorway, where few points meet again, and in a wood.
constexpr double kSteady = 0.7;

/// Of the points of the second half, this share agrees with a motion that is shown. In a sweep that
/// was seen once, wrong motions had at most 0.44; in two sweeps, right ones have 0.26 to 0.88.
constexpr double kShown = 0.5;

/// A search that comes back to rest has found it, if this share of the points with planes that face
/// the weak direction say so: nine of ten at rest, and a quarter of those of a road at 30 m/s.
constexpr double kSayingSo = 0.5;
/// A direction with less than this share of the information is held weakly.
constexpr double kWeakShare = 0.02;
/// The search along a weak direction has this many starts, up to this speed forward and backward.
/// Nothing faster is believed.
constexpr std::size_t kSearchStarts = 16;
constexpr double kFastest_m_s = 50.0;
constexpr int kSearchFirstRound = 2;
constexpr int kSearchLastRound = 8;
/// The size of a place, in median ranges.
constexpr double kPlaceInMedians = 0.5;
/// Of the votes elsewhere. Of 119 simulated starts on motorways and along facades, all 97 with more
/// were right, and the wrong ones had at most 1.9.
constexpr double kClearDeviations = 2.0;

/// What the points of the second half say of a motion over the interval.
struct MotionEvidence {
  int agreeing = 0;    ///< How many lie on planes of the first half, ...
  int with_plane = 0;  ///< ... and how many have one.
  /// See MotionHypothesis::VotesAlong: of planes that face the direction which is held weakly, if
  /// one is. Of the others, many agree with any motion along it.
  int votes = 0;
};

struct InitialMotion {
  /// The body's twist over the whole first interval: T(alpha) = Exp(alpha tau).
  Vector6d tau = Vector6d::Zero();
  MotionEvidence found;                           ///< For tau.
  MotionEvidence at_rest;                         ///< For a sensor that stood still.
  std::optional<Eigen::Vector3d> open_direction;  ///< See FirstMotion.
};

/// The first interval, and ways to look at it.
class FirstInterval {
 public:
  FirstInterval(const SegmentCloud& cloud, const OdometryOptions& options, ThreadPool* threads)
      : cloud_(cloud), options_(options), threads_(threads) {
    halves_.lidar_origins_body_m = cloud.lidar_origins_body_m;
    std::vector<SegmentPoint> second_half;
    for (const SegmentPoint& point : cloud.map_points) {
      (point.alpha < 0.5F ? halves_.map_points : second_half).push_back(point);
    }
    VoxelFilter(kSpacing_m).Filter(second_half, &halves_.registration_points);
    std::vector<float> ranges_m;
    for (const SegmentPoint& point : halves_.registration_points) {
      ranges_m.push_back(point.p_body_m.norm());
    }
    place_m_ = kPlaceInMedians * UpperMedian(std::move(ranges_m));
  }

  int points() const { return static_cast<int>(halves_.registration_points.size()); }
  double Duration_s() const { return cloud_.Duration_s(); }

  MotionHypothesis At(const Vector6d& tau) const {
    return {halves_, tau, Coarsened(options_.map, 1.0), threads_};
  }

  int VotesAlong(const Eigen::Vector3d& direction, const MotionHypothesis& hypothesis) const {
    return hypothesis.VotesAlong(direction, place_m_);
  }

  /// Whether what faces a direction says that the motion along it is the right one.
  bool IsShownAlong(const Eigen::Vector3d& direction, const Vector6d& tau) const {
    const MotionHypothesis hypothesis = At(tau);
    return hypothesis.AgreeingAlong(direction) > kSayingSo * hypothesis.FacingAlong(direction);
  }

  /// To look for the way along a direction: the interval without most of what says nothing about
  /// it, judged by the surfaces that it shows under `tau`.
  FirstInterval Along(const Eigen::Vector3d& direction, const Vector6d& tau) const {
    FirstInterval along = *this;
    along.direction_ = direction;
    // The surfaces are those of the whole interval: it sees each of them better than a half does.
    SegmentCloud whole = halves_;
    whole.map_points = cloud_.map_points;
    along.halves_.registration_points =
        MotionHypothesis(whole, tau, Coarsened(options_.map, 1.0), threads_)
            .TellingAlong(direction, halves_.registration_points);
    return along;
  }

  /// The motion near `tau` by rounds of registration; the first ones see coarsely.
  Vector6d Refine(Vector6d tau, int first_round, int last_round) const {
    for (int round = first_round; round < last_round; ++round) {
      const double coarse = Coarseness(round);
      const RegistrationNormalEquations equations = Linearize(tau, coarse);
      Vector6d prior = Vector6d::Constant(1.0 / (kPriorSigma_m * kPriorSigma_m));
      prior.tail<3>().setConstant(1.0 / (kPriorSigma_rad * kPriorSigma_rad));
      Matrix6d H = equations.H.bottomRightCorner<6, 6>();
      H.diagonal() += prior;
      const Vector6d g = equations.g.tail<6>() + prior.cwiseProduct(tau);
      Vector6d xi = -H.ldlt().solve(g);
      if (!xi.allFinite()) return Vector6d::Zero();
      if (round >= kDampedFrom) xi *= 0.5;
      tau = se3::Log(se3::Exp(tau) * se3::Exp(xi));
      const StepSize step = {xi.head<3>().norm(), xi.tail<3>().norm()};
      if (coarse == 1.0 && step.IsWithin(kSettledStep)) break;
    }
    return tau;
  }

  /// The direction of translation that the points hold least, in the world, if they hold it weakly.
  std::optional<Eigen::Vector3d> WeakDirection(const Vector6d& tau) const {
    const Eigen::Matrix3d H = Linearize(tau, 1.0).H.block<3, 3>(6, 6);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(H);
    if (eigen.eigenvalues()[0] > kWeakShare * H.trace()) return std::nullopt;
    return se3::Exp(tau).q * eigen.eigenvectors().col(0);
  }

 private:
  RegistrationNormalEquations Linearize(const Vector6d& tau, double coarse) const {
    const MotionHypothesis hypothesis(halves_, tau, Coarsened(options_.map, coarse), threads_);
    const RegistrationNoise noise = CoarsenedNoise(options_.registration, coarse);
    return direction_ ? hypothesis.LinearizeAlong(*direction_, noise) : hypothesis.Linearize(noise);
  }

  const SegmentCloud& cloud_;
  const OdometryOptions& options_;
  ThreadPool* threads_;
  SegmentCloud halves_;                       ///< As MotionHypothesis takes them.
  double place_m_ = 0.0;                      ///< See MotionHypothesis.
  std::optional<Eigen::Vector3d> direction_;  ///< Of the way that is looked for, if of one.
};

/// Where the points hold one direction weakly (along a road), a search ends near where it starts.
/// So it is started again at steps along that direction. What does not face it has no say in the
/// way along it, and what does is the judge: one of the ends must have many more votes than any
/// other way has.
Vector6d SearchAlong(const Eigen::Vector3d& direction, const FirstInterval& interval,
                     const Vector6d& found, ThreadPool* threads) {
  const FirstInterval along = interval.Along(direction, found);
  const double found_m = found.head<3>().dot(direction);
  const double step_m = 2.0 * kFastest_m_s * interval.Duration_s() / (kSearchStarts - 1);
  std::vector<Vector6d> taus(kSearchStarts + 1, found);
  std::vector<int> votes(kSearchStarts + 1);
  threads->ParallelFor(taus.size(), [&](std::size_t i) {
    if (i < kSearchStarts) {  // What was found is the last one.
      const double start_m = step_m * (static_cast<double>(i) - 0.5 * (kSearchStarts - 1));
      taus[i].head<3>() += (start_m - found_m) * direction;
      taus[i] = along.Refine(taus[i], kSearchFirstRound, kSearchLastRound);
    }
    votes[i] = interval.VotesAlong(direction, interval.At(taus[i]));
  });
  const auto most = std::max_element(votes.begin(), votes.end());
  const Vector6d best = along.Refine(taus[static_cast<std::size_t>(most - votes.begin())],
                                     kSearchFirstRound, kRounds);
  double elsewhere = 1.0;
  for (std::size_t i = 0; i < taus.size(); ++i) {
    const double apart_m = std::abs((taus[i] - best).head<3>().dot(direction));
    if (apart_m > 0.5 * step_m) elsewhere = std::max(elsewhere, static_cast<double>(votes[i]));
  }
  const double clearly = elsewhere + kClearDeviations * std::sqrt(elsewhere);
  return interval.VotesAlong(direction, interval.At(best)) < clearly ? found : best;
}

InitialMotion EstimateInitialMotion(const FirstInterval& interval, ThreadPool* threads) {
  InitialMotion motion;
  if (interval.points() == 0) return motion;
  motion.tau = interval.Refine(Vector6d::Zero(), 0, kRounds);
  const auto direction = interval.WeakDirection(motion.tau);
  const bool is_at_rest = motion.tau.head<3>().norm() < kAtRest_m;
  const bool is_searched =
      direction && !(is_at_rest && interval.IsShownAlong(*direction, motion.tau));
  if (is_searched) {
    motion.open_direction = direction;
    motion.tau = SearchAlong(*direction, interval, motion.tau, threads);
  }
  const auto evidence_for = [&](const Vector6d& tau) {
    const MotionHypothesis hypothesis = interval.At(tau);
    return MotionEvidence{hypothesis.Agreeing(), hypothesis.WithPlane(),
                          is_searched ? interval.VotesAlong(*direction, hypothesis) : 0};
  };
  motion.found = evidence_for(motion.tau);
  motion.at_rest = evidence_for(Vector6d::Zero());
  return motion;
}

}  // namespace

FirstMotion MotionOfFirstInterval(const SegmentCloud& cloud, const OdometryOptions& options,
                                  ThreadPool* threads) {
  const double duration_s = cloud.Duration_s();
  if (!options.initialization.estimate_motion || !(duration_s > 0.0)) return {};
  const FirstInterval interval(cloud, options, threads);
  const InitialMotion motion = EstimateInitialMotion(interval, threads);
  const MotionEvidence &found = motion.found, &at_rest = motion.at_rest;
  const double way_m = motion.tau.head<3>().norm();
  const double gain = way_m > kClearMotion_m ? 1.0 : kMinGain;
  const bool is_believed =
      way_m < kFastest_m_s * duration_s &&
      (found.agreeing > gain * at_rest.agreeing || found.votes > gain * at_rest.votes);
  const MotionEvidence& taken = is_believed ? found : at_rest;
  FirstMotion first;
  first.is_at_rest = way_m < kAtRest_m && motion.tau.tail<3>().norm() < kAtRest_rad;
  first.is_steady = first.is_at_rest || taken.agreeing > kSteady * taken.with_plane;
  first.is_shown = taken.agreeing > kShown * interval.points();
  first.open_direction = motion.open_direction;
  if (is_believed) first.velocity = motion.tau / duration_s;
  return first;
}

}  // namespace trajlo
