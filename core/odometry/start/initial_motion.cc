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
#include "core/odometry/window/association.h"
#include "core/scans/median.h"
#include "factors/plane_distances.h"
#include "factors/segment_linearizer.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

constexpr int kRounds = 20;
/// From here on steps are halved: the choice of neighbours makes the last centimetre flip to and
/// fro.
constexpr int kDampedFrom = 8;
/// The second half has one point in a cell of this size, and no fewer: few may face a direction
/// that is held weakly.
constexpr double kSpacing_m = 0.4;
/// A point this near to its plane speaks for a hypothesis.
constexpr double kAgreementM = 0.05;
/// A start faster than this is not expected; it only holds directions that nobody measures.
constexpr double kPriorSigmaM = 10.0;
constexpr double kPriorSigmaRad = 2.0;
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
/// Of the points that have a plane, so many are on it where a constant twist explains the interval:
/// 0.8 to 0.9 at rest, 0.7 to 0.8 in a street and on a steady walk, 0.1 to 0.6 in a flight with
/// quick turns. On a motorway, where few points meet again, and in a wood it is 0.3 to 0.6, too:
/// there the first segment does as well.
constexpr double kSteady = 0.7;

/// A search that comes back to rest has found it, if so many of the points with planes that face
/// the weak direction say so: nine of ten at rest, and a quarter of those of a road at 30 m/s.
constexpr double kSayingSo = 0.5;
/// A direction with less than this share of the information is held weakly.
constexpr double kWeakShare = 0.02;
/// Planes whose normals have at least this cosine with a direction face it.
constexpr double kFacing = 0.5;
/// The search along a weak direction has so many starts, so far apart: 50 m/s over 0.3 s.
constexpr int kSearchStarts = 16;
constexpr double kSearchStep_m = 2.0;
constexpr int kSearchFirstRound = 2;
constexpr int kSearchLastRound = 11;
/// Of a number of points that agree by chance.
constexpr double kClearDeviations = 5.0;

/// The first half's points as a map, moved with the hypothesis, and the second half's planes in it.
class Hypothesis {
 public:
  Hypothesis(const SegmentCloud& cloud, const std::vector<SegmentPoint>& second_half,
             const Vector6d& tau, const MapPyramidOptions& map_options, ThreadPool* threads)
      : T_end_(se3::Exp(tau)), points_(static_cast<double>(second_half.size())) {
    const SegmentMotion motion(SE3(), T_end_);
    std::vector<Eigen::Vector3d> first_half;
    for (const SegmentPoint& point : cloud.map_points) {
      if (point.alpha >= 0.5F) continue;
      first_half.push_back(motion.ToWorld(point.alpha, point.p_body_m.cast<double>()));
    }
    MapPyramid map(map_options);
    map.Insert(first_half);
    SegmentAssociation().Associate(second_half, cloud.lidar_origins_body_m, SE3(), T_end_, map,
                                   threads, &points_with_plane_);
  }

  RegistrationNormalEquations Linearize(const RegistrationNoise& noise) const {
    return LinearizeSegment(points_with_plane_, SE3(), T_end_, noise);
  }

  /// Share of the second half's points that lie within kAgreementM of a plane. With `direction` (a
  /// unit vector in the world), only of planes that face it: these tell how far one has moved along
  /// it, whatever the others say.
  double Agreement(const std::optional<Eigen::Vector3d>& direction = std::nullopt) const {
    int agreeing = 0;
    ForEachDistance(points_with_plane_, SegmentMotion(SE3(), T_end_), 1,
                    [&](const RegistrationPoint& point, double distance_m) {
                      if (direction && !IsFacing(point, *direction)) return;
                      agreeing += std::abs(distance_m) < kAgreementM ? 1 : 0;
                    });
    return agreeing / points_;
  }

  /// The same, as a share of the points that have a plane.
  double AgreementWithPlanes() const {
    const auto with_plane = static_cast<double>(points_with_plane_.size());
    return with_plane > 0.0 ? Agreement() * points_ / with_plane : 0.0;
  }

  /// Share of the second half's points that have a plane which faces `direction`, near or far.
  double Facing(const Eigen::Vector3d& direction) const {
    return static_cast<double>(std::count_if(
               points_with_plane_.begin(), points_with_plane_.end(),
               [&](const RegistrationPoint& point) { return IsFacing(point, direction); })) /
           points_;
  }

 private:
  static bool IsFacing(const RegistrationPoint& point, const Eigen::Vector3d& direction) {
    return std::abs(point.normal_world.dot(direction)) >= kFacing;
  }

  SE3 T_end_;
  double points_;
  std::vector<RegistrationPoint> points_with_plane_;
};

/// The first interval, and ways to look at it.
class FirstInterval {
 public:
  FirstInterval(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                const RegistrationOptions& registration, ThreadPool* threads)
      : cloud_(cloud), map_options_(map_options), registration_(registration), threads_(threads) {
    map_options_.finest.kind = MapKind::kVoxelHash;
    std::vector<SegmentPoint> all;
    for (const SegmentPoint& point : cloud.map_points) {
      if (point.alpha >= 0.5F) all.push_back(point);
    }
    VoxelFilter(kSpacing_m).Filter(all, &second_half_);
  }

  bool is_empty() const { return second_half_.empty(); }
  /// Points of the second half.
  double size() const { return static_cast<double>(second_half_.size()); }

  Hypothesis At(const Vector6d& tau) const {
    return Hypothesis(cloud_, second_half_, tau, map_options_, threads_);
  }

  double Agreement(const Vector6d& tau,
                   const std::optional<Eigen::Vector3d>& direction = std::nullopt) const {
    return At(tau).Agreement(direction);
  }

  /// Whether what faces a direction says that the motion along it is the right one.
  bool IsShownAlong(const Eigen::Vector3d& direction, const Vector6d& tau) const {
    const Hypothesis hypothesis = At(tau);
    return hypothesis.Agreement(direction) > kSayingSo * hypothesis.Facing(direction);
  }

  /// The motion near `tau` by rounds of registration; the first ones see coarsely.
  Vector6d Refine(Vector6d tau, int first_round, int last_round) const {
    for (int round = first_round; round < last_round; ++round) {
      // 4, 4, 2, 2, 1, 1, ... times the map's voxels and the kernel.
      const double coarse = std::max(1.0, 4.0 / (1 << (round / 2)));
      const RegistrationNormalEquations equations = Linearize(tau, coarse);
      Vector6d prior = Vector6d::Constant(1.0 / (kPriorSigmaM * kPriorSigmaM));
      prior.tail<3>().setConstant(1.0 / (kPriorSigmaRad * kPriorSigmaRad));
      Matrix6d H = equations.H.bottomRightCorner<6, 6>();
      H.diagonal() += prior;
      const Vector6d g = equations.g.tail<6>() + prior.cwiseProduct(tau);
      Vector6d xi = -H.ldlt().solve(g);
      if (!xi.allFinite()) return Vector6d::Zero();
      if (round >= kDampedFrom) xi *= 0.5;
      tau = se3::Log(se3::Exp(tau) * se3::Exp(xi));
      if (coarse == 1.0 && xi.head<3>().norm() < 2e-3 && xi.tail<3>().norm() < 2e-4) break;
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
    MapPyramidOptions map = map_options_;
    map.finest.voxel_size_m *= coarse;
    RegistrationOptions registration = registration_;
    registration.kernel_m *= coarse;
    return Hypothesis(cloud_, second_half_, tau, map, threads_)
        .Linearize(MakeRegistrationNoise(registration));
  }

  const SegmentCloud& cloud_;
  MapPyramidOptions map_options_;
  const RegistrationOptions& registration_;
  ThreadPool* threads_;
  std::vector<SegmentPoint> second_half_;
};

/// Where the points hold one direction weakly (along a road), a search ends near where it starts.
/// So it is started again at steps along that direction, and judged by the planes that face it: at
/// one of them, many more points must agree than chance brings about at the others.
Vector6d SearchAlong(const Eigen::Vector3d& direction, const FirstInterval& interval,
                     const Vector6d& found) {
  const double found_m = found.head<3>().dot(direction);
  Vector6d best = found;
  double best_agreement = interval.Agreement(found, direction);
  std::vector<double> agreements;
  for (int i = 0; i < kSearchStarts; ++i) {
    const double start_m = kSearchStep_m * (i - 0.5 * (kSearchStarts - 1));
    Vector6d start = found;
    start.head<3>() += (start_m - found_m) * direction;
    const Vector6d tau = interval.Refine(start, kSearchFirstRound, kSearchLastRound);
    agreements.push_back(interval.Agreement(tau, direction));
    if (agreements.back() <= best_agreement) continue;
    best = tau;
    best_agreement = agreements.back();
  }
  const double chance = interval.size() * UpperMedian(std::move(agreements));
  const double clear = chance + kClearDeviations * std::sqrt(std::max(chance, 1.0));
  if (interval.size() * best_agreement < clear) return found;
  return interval.Refine(best, kSearchFirstRound, kRounds);
}

}  // namespace

InitialMotion EstimateInitialMotion(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                                    const RegistrationOptions& registration, ThreadPool* threads) {
  InitialMotion motion;
  const FirstInterval interval(cloud, map_options, registration, threads);
  if (interval.is_empty()) return motion;
  motion.tau = interval.Refine(Vector6d::Zero(), 0, kRounds);
  motion.agreement_at_rest = interval.Agreement(Vector6d::Zero());
  const auto direction = interval.WeakDirection(motion.tau);
  const bool is_at_rest = motion.tau.head<3>().norm() < kAtRest_m;
  if (direction && !(is_at_rest && interval.IsShownAlong(*direction, motion.tau))) {
    motion.tau = SearchAlong(*direction, interval, motion.tau);
    motion.facing_agreement = interval.Agreement(motion.tau, direction);
    motion.facing_agreement_at_rest = interval.Agreement(Vector6d::Zero(), direction);
  }
  const Hypothesis found = interval.At(motion.tau);
  motion.agreement = found.Agreement();
  motion.agreement_with_planes = found.AgreementWithPlanes();
  return motion;
}

FirstMotion MotionOfFirstInterval(const SegmentCloud& cloud, const InitializationOptions& options,
                                  const MapPyramidOptions& map_options,
                                  const RegistrationOptions& registration, ThreadPool* threads) {
  const double duration_s = cloud.Duration_s();
  if (!options.estimate_motion || !(duration_s > 0.0)) return {};
  const InitialMotion motion = EstimateInitialMotion(cloud, map_options, registration, threads);
  const double way_m = motion.tau.head<3>().norm();
  const bool hardly_moves = way_m < kAtRest_m && motion.tau.tail<3>().norm() < kAtRest_rad;
  const bool is_steady = hardly_moves || motion.agreement_with_planes > kSteady;
  const double gain = way_m > kClearMotion_m ? 1.0 : kMinGain;
  const bool is_believed = motion.agreement > gain * motion.agreement_at_rest ||
                           motion.facing_agreement > gain * motion.facing_agreement_at_rest;
  if (!is_believed) return {Vector6d::Zero(), is_steady};
  return {motion.tau / duration_s, is_steady};
}

}  // namespace trajlo
