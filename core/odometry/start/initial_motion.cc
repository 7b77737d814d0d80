// SPDX-License-Identifier: MIT
#include "core/odometry/start/initial_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "factors/segment_registration.h"
#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

constexpr int kRounds = 20;
/// From here on steps are halved: the choice of neighbours makes the last centimetre flip to and
/// fro.
constexpr int kDampedFrom = 8;
/// A point this near to its plane speaks for a hypothesis.
constexpr double kAgreementM = 0.05;
/// A start faster than this is not expected; it only holds directions that nobody measures.
constexpr double kPriorSigmaM = 10.0;
constexpr double kPriorSigmaRad = 2.0;

/// The first half's points as a map, moved with the hypothesis, and the second half's planes in it.
class Hypothesis {
 public:
  Hypothesis(const SegmentCloud& cloud, const std::vector<SegmentPoint>& second_half,
             const Vector6d& tau, const MapPyramidOptions& map_options,
             const AssociationOptions& association, ThreadPool* threads)
      : T_end_(se3::Exp(tau)), points_(static_cast<double>(second_half.size())) {
    const SegmentMotion motion(SE3(), T_end_);
    std::vector<Eigen::Vector3d> first_half;
    for (const SegmentPoint& point : cloud.map_points) {
      if (point.alpha >= 0.5F) continue;
      first_half.push_back(motion.ToWorld(point.alpha, point.p_body_m.cast<double>()));
    }
    MapPyramid map(map_options);
    map.Insert(first_half);
    planes_.Associate(second_half, SE3(), T_end_, map, association, map_options.finest.voxel_size_m,
                      true, threads, &points_with_plane_);
  }

  RegistrationNormalEquations Linearize(const RegistrationNoise& noise) const {
    return LinearizeSegment(points_with_plane_, SE3(), T_end_, noise);
  }

  /// Share of the second half's points that lie within kAgreementM of a plane.
  double Agreement() const {
    int agreeing = 0;
    const SegmentMotion motion(SE3(), T_end_);
    for (const RegistrationPoint& point : points_with_plane_) {
      const double distance_m =
          point.normal_world.dot(motion.ToWorld(point.alpha, point.p_body_m)) - point.offset_m;
      agreeing += std::abs(distance_m) < kAgreementM;
    }
    return agreeing / points_;
  }

 private:
  SE3 T_end_;
  double points_;
  SegmentAssociation planes_;
  std::vector<RegistrationPoint> points_with_plane_;
};

}  // namespace

InitialMotion EstimateInitialMotion(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                                    const AssociationOptions& association,
                                    const RegistrationOptions& registration, ThreadPool* threads) {
  std::vector<SegmentPoint> second_half;
  for (const SegmentPoint& point : cloud.registration_points) {
    if (point.alpha >= 0.5F) second_half.push_back(point);
  }
  InitialMotion motion;
  if (second_half.empty()) return motion;
  MapPyramidOptions hash = map_options;
  hash.finest.kind = MapKind::kVoxelHash;

  Vector6d prior = Vector6d::Constant(1.0 / (kPriorSigmaM * kPriorSigmaM));
  prior.tail<3>().setConstant(1.0 / (kPriorSigmaRad * kPriorSigmaRad));
  bool converged = false;
  for (int round = 0; round < kRounds && !converged; ++round) {
    // 4, 4, 2, 2, 1, 1, ... times the map's voxels, plane thickness and kernel.
    const double coarse = std::max(1.0, 4.0 / (1 << (round / 2)));
    MapPyramidOptions coarse_map = hash;
    coarse_map.finest.voxel_size_m *= coarse;
    AssociationOptions coarse_association = association;
    coarse_association.plane.max_thickness_m *= coarse;
    const Hypothesis hypothesis(cloud, second_half, motion.tau, coarse_map, coarse_association,
                                threads);
    const RegistrationNoise noise =
        MakeRegistrationNoise(registration, coarse * registration.max_kernel_m);
    const RegistrationNormalEquations equations = hypothesis.Linearize(noise);
    Matrix6d H = equations.H.bottomRightCorner<6, 6>();
    H.diagonal() += prior;
    const Vector6d g = equations.g.tail<6>() + prior.cwiseProduct(motion.tau);
    Vector6d xi = -H.ldlt().solve(g);
    if (!xi.allFinite()) return {};
    if (round >= kDampedFrom) xi *= 0.5;
    motion.tau = se3::Log(se3::Exp(motion.tau) * se3::Exp(xi));
    converged = coarse == 1.0 && xi.head<3>().norm() < 2e-3 && xi.tail<3>().norm() < 2e-4;
  }
  motion.agreement =
      Hypothesis(cloud, second_half, motion.tau, hash, association, threads).Agreement();
  motion.agreement_at_rest =
      Hypothesis(cloud, second_half, Vector6d::Zero(), hash, association, threads).Agreement();
  return motion;
}

Vector6d MotionOfFirstInterval(const SegmentCloud& cloud, const InitializationOptions& options,
                               const MapPyramidOptions& map_options,
                               const AssociationOptions& association,
                               const RegistrationOptions& registration, ThreadPool* threads) {
  if (!options.estimate_motion) return Vector6d::Zero();
  const InitialMotion motion =
      EstimateInitialMotion(cloud, map_options, association, registration, threads);
  const bool is_clear = motion.tau.head<3>().norm() > options.clear_motion_m;
  const double gain = is_clear ? 1.0 : options.min_gain;
  const bool is_believed = motion.agreement > gain * motion.agreement_at_rest;
  return is_believed ? motion.tau : Vector6d(Vector6d::Zero());
}

}  // namespace trajlo
