// SPDX-License-Identifier: MIT
#include "core/odometry/start/settle_poses.h"

#include <array>
#include <cmath>
#include <utility>

#include "core/odometry/start/coarse_to_fine.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/window/enter_map.h"
#include "core/odometry/window/push_segment.h"
#include "core/odometry/window/step_size.h"
#include "core/odometry/window/window_equations.h"
#include "factors/plane_distances.h"

namespace trajlo {
namespace {

constexpr int kRounds = 8;
/// Both halves would go the whole way to meet the other, and miss it by as much.
constexpr double kDamping = 0.5;

/// A window whose segments are two halves, each of which is the other's map.
class Halves {
 public:
  Halves(Window window, const OdometryOptions& options, ThreadPool* threads)
      : window_(std::move(window)), options_(options), threads_(threads) {}

  /// Finds planes for all points, in voxels that are `coarse` times as large.
  void Associate(double coarse) {
    const MapPyramidOptions options = Coarsened(options_.map, coarse);
    std::array<MapPyramid, 2> maps = {MapPyramid(options), MapPyramid(options)};
    for (int k = 0; k < window_.size(); ++k) {
      EnterMap(window_.At(k).cloud, window_.Pose(k), window_.Pose(k + 1), threads_,
               &maps[IsSecond(k) ? 1 : 0]);
    }
    for (int k = 0; k < window_.size(); ++k) {
      Segment& segment = window_.At(k);
      SegmentAssociation().Associate(segment.cloud, window_.Pose(k), window_.Pose(k + 1),
                                     maps[IsSecond(k) ? 0 : 1], threads_, &segment.points);
    }
  }

  /// A damped step of Gauss-Newton, with kernels that are `coarse` times as wide. Returns whether
  /// it was small, or none could be made.
  bool Step(double coarse) {
    const RegistrationNoise noise = CoarsenedNoise(options_.registration, coarse);
    std::vector<RegistrationNormalEquations> of_segments;
    for (int k = 0; k < window_.size(); ++k) {
      of_segments.push_back(
          LinearizeSegment(window_.At(k).points, window_.Pose(k), window_.Pose(k + 1), noise));
    }
    const std::vector<SE3> before = window_.Poses();
    WindowNormalEquations equations;
    AssembleWindow(window_, before, of_segments, &equations);
    std::vector<SE3> after = before;
    if (!TakeStep(kDamping * SolveNormalEquations(equations), &after)) return true;
    window_.SetPoses(after);
    return MeasureStep(before, after).IsWithin(kSettledStep);
  }

  int Agreeing() const {
    int count = 0;
    for (int k = 0; k < window_.size(); ++k) {
      ForEachDistance(window_.At(k).points, window_.Motion(k), 1,
                      [&](const RegistrationPoint&, double distance_m) {
                        count += std::abs(distance_m) < kAgreement_m ? 1 : 0;
                      });
    }
    return count;
  }

  /// Moved as a whole, so that the first one stays where it was.
  std::vector<SE3> PosesFrom(const SE3& first) const {
    std::vector<SE3> poses = window_.Poses();
    const SE3 move = first * poses.front().Inverse();
    for (SE3& T : poses) T = move * T;
    return poses;
  }

 private:
  bool IsSecond(int k) const { return 2 * k >= window_.size(); }

  Window window_;
  const OdometryOptions& options_;
  ThreadPool* threads_;
};

}  // namespace

SettledPoses SettlePoses(const std::vector<SegmentCloud>& segments, const std::vector<SE3>& poses,
                         bool is_coarse, const OdometryOptions& options, ThreadPool* threads) {
  Window window = MakeWindow(segments.front().begin_ns, poses.front());
  const Vector6d velocity = Minus(poses[1], poses[0]) / segments.front().Duration_s();
  for (const SegmentCloud& cloud : segments) {
    PushSegment(cloud, velocity, Deskewing::kEstimated, &window);
  }
  window.SetPoses(poses);
  MotionPrior(options.motion_prior).Apply(&window);
  Halves halves(std::move(window), options, threads);
  for (int round = 0; round < kRounds; ++round) {
    const double coarse = is_coarse ? Coarseness(round) : 1.0;
    halves.Associate(coarse);
    if (halves.Step(coarse) && coarse == 1.0) break;
  }
  halves.Associate(1.0);
  return {halves.PosesFrom(poses.front()), halves.Agreeing()};
}

}  // namespace trajlo
