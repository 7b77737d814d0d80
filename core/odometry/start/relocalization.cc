// SPDX-License-Identifier: MIT
#include "core/odometry/start/relocalization.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/odometry/segments/choose_evenly.h"
#include "core/odometry/segments/voxel_filter.h"
#include "core/odometry/window/association.h"
#include "core/odometry/window/points_to_world.h"
#include "core/odometry/window/rigid_motion.h"
#include "core/odometry/window/step_size.h"
#include "factors/segment_linearizer.h"

namespace trajlo {
namespace {

/// What tells a place from others takes up this many cells of this size. A hand before the LiDAR
/// takes up half as many, however many points it has, and fits into corners everywhere.
constexpr double kCell_m = 0.4;
constexpr std::size_t kFewestCells = 100;
/// At most this many places are refined.
constexpr std::size_t kPlaces = 24;
constexpr std::size_t kMaxPoints = 800;
/// Of a refinement. Its kernel is this many times as wide at first: for a place out of a search,
/// and then for the motion during the sweep.
constexpr int kRounds = 9;
constexpr int kWideAtPlace = 8;
constexpr int kWideInMotion = 4;
/// Holds what the points do not, as a share of their information.
constexpr double kDamping = 1e-4;
/// Places that the refinement brings nearer to each other than this are one.
constexpr double kSame_m = 0.5;
constexpr double kSame_rad = 0.12;
/// A point this near to its plane speaks for a place.
constexpr double kAgreement_m = 0.12;
/// A ray goes through a surface if it passes a point of the map this closely, not near its ends.
constexpr double kPassed_m = 0.1;
constexpr double kRayStep_m = 0.2;
constexpr double kRayBegin_m = 0.6;
constexpr double kRayEnd_m = 0.8;
constexpr double kLongestRay_m = 20.0;
/// Two places disagree on a point if the one's plane is as far as this from it under the other.
constexpr double kDisagreement_m = 0.3;
/// What makes a place clear: this share of all points, ...
constexpr double kMinAgreement = 0.5;
/// ... and of those that have a plane, near or far, ...
constexpr double kMinPrecision = 0.6;
/// ... this many times the points of a rival, among those that speak for one of the two alone, and
/// this share of all points, ...
constexpr double kMinRatio = 3.0;
constexpr double kMinDisputed = 0.03;
/// ... and in every direction this share of the information about translation.
constexpr double kWeakShare = 0.01;

/// A place, and which planes of the map the points of the sweep find there.
class Hypothesis {
 public:
  Hypothesis(const SegmentCloud& sweep, const Vector6d& tau, const MapPyramid& map,
             ThreadPool* threads)
      : sweep_(sweep), T_begin_end_(se3::Exp(tau)), map_(map), threads_(threads) {}

  /// Brings the sweep as a rigid cloud onto the map.
  void Place(const SE3& start, const RegistrationOptions& registration) {
    T_begin_ = start;
    Associate();
    Refine(kWideAtPlace, true, registration);
  }

  /// Refines the motion during the sweep as well, which was only known roughly.
  void Move(const RegistrationOptions& registration) { Refine(kWideInMotion, false, registration); }

  /// Finds the points that speak for this place.
  void Judge() {
    const SegmentMotion motion = Motion();
    const std::vector<SegmentPoint>& all = sweep_.registration_points;
    found_.assign(all.size(), {});
    std::size_t i = 0;
    for (const RegistrationPoint& point : points_) {
      while (!IsSamePoint(point, all[i])) ++i;
      const Eigen::Vector3d p_world = motion.ToWorld(point.alpha, point.p_body_m);
      const Eigen::Vector3d origin_world =
          motion.ToWorld(point.alpha, sweep_.lidar_origins_body_m[all[i].lidar]);
      Found& found = found_[i++];
      found.normal = point.normal_world;
      found.agrees = std::abs(point.DistanceToPlane(p_world)) < kAgreement_m &&
                     !GoesThroughSurface(origin_world, p_world);
      agreeing_ += found.agrees ? 1 : 0;
    }
  }

  const SE3& T_begin() const { return T_begin_; }
  Vector6d tau() const { return se3::Log(T_begin_end_); }
  /// Points that lie on planes, with nothing of the map in their way.
  int agreeing() const { return agreeing_; }
  /// Those that have one, near or far.
  int with_plane() const { return static_cast<int>(points_.size()); }

  bool IsAt(const Hypothesis& other) const {
    return MeasureStep(T_begin_, other.T_begin_).IsWithin({kSame_m, kSame_rad});
  }

  bool HoldsAllDirections() const {
    const Eigen::Matrix3d translation = information_.topLeftCorner<3, 3>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(translation);
    return eigen.eigenvalues()[0] > kWeakShare * translation.trace();
  }

  struct Disputed {
    int mine = 0, rivals = 0;
  };
  /// How many points speak for this place alone, and for its rival alone; only those whose plane
  /// says that they cannot lie where the other place has them.
  Disputed DisputedWith(const Hypothesis& rival) const {
    Disputed disputed;
    const SegmentMotion here = Motion(), there = rival.Motion();
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const bool is_mine = found_[i].agrees;
      if (is_mine == rival.found_[i].agrees) continue;
      const Eigen::Vector3d& normal = (is_mine ? found_[i] : rival.found_[i]).normal;
      const SegmentPoint& point = sweep_.registration_points[i];
      const Eigen::Vector3d p = point.p_body_m.cast<double>();
      const Eigen::Vector3d way = there.ToWorld(point.alpha, p) - here.ToWorld(point.alpha, p);
      const bool is_disputed = std::abs(normal.dot(way)) > kDisagreement_m;
      (is_mine ? disputed.mine : disputed.rivals) += is_disputed ? 1 : 0;
    }
    return disputed;
  }

 private:
  struct Found {
    bool agrees = false;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  SE3 T_end() const { return T_begin_ * T_begin_end_; }
  SegmentMotion Motion() const { return {T_begin_, T_end()}; }

  bool GoesThroughSurface(const Eigen::Vector3d& origin, const Eigen::Vector3d& end) const {
    const double range_m = (end - origin).norm();
    const Eigen::Vector3d direction = (end - origin) / range_m;
    const double last_m = std::min(range_m - kRayEnd_m, kLongestRay_m);
    Neighbors nearest;
    const auto steps = static_cast<int>(std::ceil((last_m - kRayBegin_m) / kRayStep_m));
    for (int i = 0; i < steps; ++i) {
      const double way_m = kRayBegin_m + kRayStep_m * i;
      map_.finest().Nearest(origin + way_m * direction, 1, &nearest);
      if (nearest.count > 0 && nearest.squared_distance[0] < kPassed_m * kPassed_m) return true;
    }
    return false;
  }

  /// The kernel is `widest` times that of `registration` at first, and halves every three rounds.
  void Refine(int widest, bool is_rigid, RegistrationOptions registration) {
    const double kernel_m = registration.kernel_m;
    for (int round = 0; round < kRounds; ++round) {
      registration.kernel_m = std::max(1, widest >> (round / 3)) * kernel_m;
      if (!Step(is_rigid, MakeRegistrationNoise(registration))) return;
    }
  }

  /// One step of Gauss-Newton, of the sweep as a whole or of its start and its end.
  bool Step(bool is_rigid, const RegistrationNoise& noise) {
    const RegistrationNormalEquations equations =
        LinearizeSegment(points_, T_begin_, T_end(), noise);
    const auto A = RigidMotionOfEnds(SE3(), SE3(), T_begin_end_);
    information_ = A.transpose() * equations.H * A;
    Vector12d xi;
    if (is_rigid) {
      const Matrix6d damping = kDamping * information_.trace() * Matrix6d::Identity();
      xi = -A * (information_ + damping).ldlt().solve(A.transpose() * equations.g);
    } else {
      const Matrix12d damping = kDamping * equations.H.trace() * Matrix12d::Identity();
      xi = -(equations.H + damping).ldlt().solve(equations.g);
    }
    if (!xi.allFinite()) return false;
    const SE3 new_T_end = Plus(T_end(), xi.tail<6>());
    T_begin_ = Plus(T_begin_, xi.head<6>());
    T_begin_end_ = T_begin_.Inverse() * new_T_end;
    Associate();
    return true;
  }

  void Associate() { association_.Associate(sweep_, T_begin_, T_end(), map_, threads_, &points_); }

  const SegmentCloud& sweep_;
  SE3 T_begin_end_;
  const MapPyramid& map_;
  ThreadPool* threads_;
  SE3 T_begin_;
  SegmentAssociation association_;
  std::vector<RegistrationPoint> points_;
  Matrix6d information_ = Matrix6d::Zero();
  std::vector<Found> found_;  ///< One for each point of the sweep.
  int agreeing_ = 0;
};

/// Seen from the body, with which a hand moves.
std::size_t CellsOf(const std::vector<SegmentPoint>& points) {
  std::vector<SegmentPoint> one_each;
  VoxelFilter(kCell_m).Filter(points, &one_each);
  return one_each.size();
}

bool IsClear(const Hypothesis& best, const std::vector<Hypothesis>& all, std::size_t points) {
  if (best.agreeing() < kMinAgreement * static_cast<double>(points)) return false;
  if (best.agreeing() < kMinPrecision * best.with_plane()) return false;
  if (!best.HoldsAllDirections()) return false;
  return std::all_of(all.begin(), all.end(), [&](const Hypothesis& rival) {
    if (&rival == &best || rival.IsAt(best)) return true;
    const Hypothesis::Disputed disputed = best.DisputedWith(rival);
    return disputed.mine > kMinRatio * disputed.rivals &&
           disputed.mine > kMinDisputed * static_cast<double>(points);
  });
}

}  // namespace

std::optional<SweepMotion> Relocalize(const SegmentCloud& sweep, const Vector6d& tau,
                                      const MapPyramid& map, const SearchRegion& region,
                                      const RegistrationOptions& registration,
                                      ThreadPool* threads) {
  if (CellsOf(sweep.registration_points) < kFewestCells) return std::nullopt;
  const bool has_motion = sweep.end_ns > sweep.begin_ns;
  SegmentCloud thin;
  thin.lidar_origins_body_m = sweep.lidar_origins_body_m;
  thin.registration_points = ChooseEvenly(sweep.registration_points, kMaxPoints);
  // In the body frame at the start.
  const std::vector<Eigen::Vector3d> rigid =
      PointsToWorld({SE3(), se3::Exp(tau)}, thin.registration_points);
  std::vector<Hypothesis> all;
  for (const SE3& place : FindPlaces(rigid, map.finest(), region, kPlaces, threads)) {
    Hypothesis hypothesis(thin, tau, map, threads);
    hypothesis.Place(place, registration);
    // The refinement may slide along what holds no direction, to where the body cannot be.
    if (!region.Holds(hypothesis.T_begin().t)) continue;
    const bool is_new = std::none_of(
        all.begin(), all.end(), [&](const Hypothesis& other) { return other.IsAt(hypothesis); });
    if (is_new) all.push_back(std::move(hypothesis));
  }
  for (Hypothesis& hypothesis : all) {
    if (has_motion) hypothesis.Move(registration);
    hypothesis.Judge();
  }
  const auto best = std::max_element(
      all.begin(), all.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.agreeing() < b.agreeing(); });
  if (best == all.end() || !IsClear(*best, all, thin.registration_points.size())) {
    return std::nullopt;
  }
  return SweepMotion{best->T_begin(), best->tau()};
}

}  // namespace trajlo
