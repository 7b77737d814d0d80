// SPDX-License-Identifier: MIT
#include "core/odometry/window/initial_motion.h"

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
             const Vector6d& tau, const MapPyramidOptions& map_options, ThreadPool* threads)
      : T_end_(se3::Exp(tau)), points_(static_cast<double>(second_half.size())) {
    const PointInterpolator to_start(SE3(), T_end_);
    std::vector<Eigen::Vector3d> first_half;
    for (const SegmentPoint& point : cloud.map_points) {
      if (point.alpha >= 0.5F) continue;
      first_half.push_back(to_start(point.alpha, point.p_body_m.cast<double>()));
    }
    MapPyramid map(map_options);
    map.Insert(first_half);
    planes_.Associate(second_half, cloud.lidar_origins_body_m, SE3(), T_end_, map, true, threads);
  }

  RegistrationNormalEquations Linearize(const RegistrationNoise& noise) const {
    return LinearizeSegment(planes_.registration_points(), SE3(), T_end_, noise);
  }

  /// Share of the second half's points that lie within kAgreementM of a plane.
  double Agreement() const {
    int agreeing = 0;
    const PointInterpolator to_start(SE3(), T_end_);
    for (const RegistrationPoint& point : planes_.registration_points()) {
      const double distance_m =
          point.normal_world.dot(to_start(point.alpha, point.p_body_m)) - point.offset_m;
      agreeing += std::abs(distance_m) < kAgreementM;
    }
    return agreeing / points_;
  }

 private:
  SE3 T_end_;
  double points_;
  SegmentAssociation planes_;
};

}  // namespace

InitialMotion EstimateInitialMotion(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                                    const WeightOptions& weights, ThreadPool* threads) {
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
    coarse_map.plane.max_thickness_m *= coarse;
    const Hypothesis hypothesis(cloud, second_half, motion.tau, coarse_map, threads);
    const RegistrationNoise noise{
        weights.registration_sigma_m,
        {weights.kernel, weights.max_kernel_m * coarse / weights.registration_sigma_m}};
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
  motion.agreement = Hypothesis(cloud, second_half, motion.tau, hash, threads).Agreement();
  motion.agreement_at_rest =
      Hypothesis(cloud, second_half, Vector6d::Zero(), hash, threads).Agreement();
  return motion;
}

}  // namespace trajlo
