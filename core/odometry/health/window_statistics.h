// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/solvers/window_solver.h"
#include "manifolds/se3.h"

namespace trajlo {

/// What can be wrong with a window; bits of WindowStatistics::flags.
enum WindowFlag : unsigned {
  kFlagNoPoints = 1u << 0,  ///< The newest segment has no points, or hardly any is on a plane of
                            ///< the map: the motion prior carries it.
  kFlagGap = 1u << 1,       ///< Before this pose is a stretch of which nothing was measured.
  kFlagReverted = 1u << 2,  ///< A solve was not finite, or went where no body gets: the
                            ///< prediction stands.
  kFlagNotConverged = 1u << 3,  ///< The rounds ran out before the steps became small.
  kFlagDegenerate = 1u << 4,    ///< A direction is held by the motion prior alone.
  kFlagLost = 1u << 5,          ///< The scene is no longer followed: see LossWatch.
  kFlagFewInliers = 1u << 6,    ///< Too few points agree with the map: InlierWatch.
  kFlagJump = 1u << 7,          ///< A pose jumped as no body does: HasJumped.
  kFlagLoneObject = 1u << 8,    ///< One object alone holds a direction, and the rest of the world
                                ///< contradicts it: LoneObjectWatch.
};

constexpr unsigned kAllFlags[] = {
    kFlagNoPoints, kFlagGap,        kFlagReverted, kFlagNotConverged, kFlagDegenerate,
    kFlagLost,     kFlagFewInliers, kFlagJump,     kFlagLoneObject,
};

/// A window that moves by more than this in a round has not settled, whatever tolerance the options
/// ask for.
constexpr StepSize kRestlessStep = {5e-3, 1e-3};
/// The same for a newest segment of any length. Beyond 0.03 s it is more by Δt^1.5, as white
/// acceleration takes a body off its course: what the points saw on the way lies on no straight
/// motion, and some planes change in every round, at the right place, too.
StepSize RestlessStep(const SegmentCloud& newest);

/// One line of windows.csv: what happened in one sliding-window solve.
struct WindowStatistics {
  static constexpr int kRoundsToSettle = 5;

  std::int64_t index = 0;
  std::int64_t begin_ns = 0;  ///< First control pose of the window.
  std::int64_t end_ns = 0;    ///< Newest control pose.
  int segments = 0;
  int points = 0;          ///< Registration points in the window.
  int inliers = 0;         ///< Those with a plane in the last round.
  int searched = 0;        ///< Map queries over all rounds; the others kept their plane.
  int rounds = 0;          ///< associate ↔ solve rounds.
  int widened_rounds = 0;  ///< The first ones, in which kernels were wider: see GraduatedKernel.
  StepSize restless = kRestlessStep;
  int restless_rounds = 0;  ///< The last round after which a step larger than that was expected.
  int iterations = 0;       ///< Solver steps over all rounds.
  int rejected_steps = 0;   ///< Those that Ceres did not take because they raise the cost.
  WindowCost cost;          ///< At the solution.
  /// Spectral densities of the acceleration for the next window: see MotionPrior.
  double translation_density_m2_s3 = 0.0;
  double rotation_density_rad2_s3 = 0.0;
  /// The share of a velocity beyond its mean that is left after 0.3 s: see VelocityPersistence.
  double velocity_persistence = 1.0;
  /// By how much the variance of the points is larger than assumed: see MotionPrior.
  double noise_factor = 1.0;
  /// How far the points moved the newest pose from where the motion prior had put it.
  StepSize correction;
  double agreement = 0.0;  ///< MapAgreement::worst, of the newest segment.
  /// What the points tell about the direction that they hold least (1/m²), and that direction, in
  /// the body frame: see WindowCondition.
  double smallest_eigenvalue = 0.0;
  Vector6d weak_direction = Vector6d::Zero();
  StepSize last_step;
  double milliseconds_segment = 0.0;
  double milliseconds_associate = 0.0;
  double milliseconds_solve = 0.0;
  double milliseconds_marginalize = 0.0;
  double milliseconds_map = 0.0;
  unsigned flags = 0;
  bool has_converged = false;
  bool is_finite = true;

  /// One more round of the window.
  void Add(const SolveSummary& solve, const SolverOptions& options);
  /// Adds the times of other rounds of the same window.
  void AddTimes(const WindowStatistics& other) {
    milliseconds_associate += other.milliseconds_associate;
    milliseconds_solve += other.milliseconds_solve;
  }
  /// Whether another round is due.
  bool GoesOn(int max_rounds) const { return rounds < max_rounds && !has_converged && is_finite; }

  /// A window that follows the scene settles within five rounds with kernels of their own width,
  /// but for the first windows of a jerk. Unlike has_converged, this does not depend on the
  /// tolerance and the rounds of the options.
  bool IsRestless() const { return restless_rounds >= widened_rounds + kRoundsToSettle; }
  double InlierShare() const { return points > 0 ? static_cast<double>(inliers) / points : 0.0; }
  /// Fewer points than at any place that is in the map have a plane.
  bool HasFewInliers() const { return InlierShare() < 0.3; }
};

/// Fills in what the window itself shows.
void Describe(const Window& window, WindowStatistics* statistics);

}  // namespace trajlo
