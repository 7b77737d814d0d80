// SPDX-License-Identifier: MIT
// The whole method on random scans: it never throws, and its poses are finite, bounded and ordered.
#include <Eigen/Eigenvalues>

#include "core/odometry/odometry.h"
#include "tests/fuzz/fuzzing.h"
#include "tests/fuzz/random_scans.h"

namespace {

using namespace trajlo;

constexpr int kMaxScans = 24;
/// The room is 15 m long, and a correction of a window at most 3 m.
constexpr double kFar_m = 1e4;

OdometryOptions RandomOptions(fuzz::ByteSource* bytes) {
  OdometryOptions options;
  options.threads = bytes->OneOf({1, 4});
  options.segmenter.interval_s = bytes->OneOf({0.05, 0.03, 0.1});
  options.window.segments = bytes->OneOf({4, 1, 2, 7});
  options.window.deskewing = bytes->OneOf({Deskewing::kEstimated, Deskewing::kPredicted});
  options.solver.kind = bytes->OneOf({SolverKind::kGaussNewton, SolverKind::kCeres});
  options.solver.max_rounds = bytes->OneOf({4, 1, 8});
  options.map.finest.kind = bytes->OneOf({MapKind::kVoxelHash, MapKind::kKdTree});
  options.map.finest.shared_planes = !bytes->Bool();
  options.map.levels = bytes->OneOf({4, 1});
  options.marginalization.first_estimate_jacobians = bytes->Bool();
  options.marginalization.enabled = !bytes->Bool();
  options.motion_prior.kind =
      bytes->OneOf({MotionPriorKind::kWhiteNoiseAcceleration, MotionPriorKind::kPseudoVelocity,
                    MotionPriorKind::kNone});
  return options;
}

void RequireSound(const Trajectory& trajectory) {
  std::optional<std::int64_t> before_ns;
  for (const ControlPose& pose : trajectory.poses()) {
    fuzz::Require(!before_ns || pose.t_ns > *before_ns, "times increase");
    fuzz::Require(pose.T_world_body.IsFinite(), "poses are finite");
    fuzz::Require(std::abs(pose.T_world_body.q.norm() - 1.0) < 1e-6, "rotations are rotations");
    fuzz::Require(pose.T_world_body.t.norm() < kFar_m, "poses are bounded");
    before_ns = pose.t_ns;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::ByteSource bytes(data, size);
  Odometry odometry(RandomOptions(&bytes));
  fuzz::RandomScans scans(&bytes);
  if (bytes.Bool()) {
    odometry.OnPose([](const ControlPose&, const Matrix6d& covariance) {
      fuzz::Require(covariance.allFinite(), "covariances are finite");
      fuzz::Require(covariance.diagonal().minCoeff() >= 0.0, "variances are not negative");
    });
  }
  odometry.OnWindow([](const WindowStatistics& window) {
    fuzz::Require(window.end_ns > window.begin_ns, "a window has a length");
    fuzz::Require(window.inliers <= window.points, "inliers are points");
    fuzz::Require(std::isfinite(window.smallest_eigenvalue), "how points hold it is a number");
  });
  std::int64_t points = 0;
  for (int i = 0; i < kMaxScans && !bytes.empty(); ++i) {
    const LidarScan scan = scans.Next();
    points += static_cast<std::int64_t>(scan.points.size());
    odometry.AddScan(scan);
  }
  odometry.Finish();
  RequireSound(odometry.trajectory());
  fuzz::Require(odometry.point_counts().received == points, "every point is counted");
  if (const auto lost_ns = odometry.lost_at_ns()) {
    fuzz::Require(odometry.trajectory().At(*lost_ns).has_value(), "it got lost on its way");
  }
  return 0;
}
