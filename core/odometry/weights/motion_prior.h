// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/weights/innovation.h"
#include "core/odometry/window/window.h"

namespace trajlo {

enum class MotionPriorKind {
  kWhiteNoiseAcceleration,  ///< Ties neighbouring segments; see WhiteNoiseAccelerationTerm.
  kPseudoVelocity,          ///< The paper's: ties a segment to the last estimate of the one before.
};

struct MotionPriorOptions {
  MotionPriorKind kind = MotionPriorKind::kWhiteNoiseAcceleration;
  /// Spectral densities of the acceleration: where self-tuning begins, or what holds without it.
  double translation_m2_s3 = 0.5;
  double rotation_rad2_s3 = 0.5;
  /// Lets the densities follow the motion.
  bool self_tuning = true;
  /// They never fall below these: a body at rest may set off at any time.
  double min_translation_m2_s3 = 0.2;
  double min_rotation_rad2_s3 = 0.2;
};

/// How freely the body is taken to move: the spectral density of its acceleration, one for
/// translation and one for rotation, found from the innovations while running.
///
/// Let z_i = correction_i / sqrt(expected variance_i) be the normalised innovation of a window. If
/// q is right, each z_i has variance 1 and is independent of the one before. If q is too small, the
/// estimate lags behind the motion: z is large and keeps its sign. So what is judged is the sum of
/// z over a short memory, s ← a s + z, a = exp(-Δt / T_s), by its own expected variance 1 / (1 -
/// a²):
///
///   u = (1 - a²) sum_i w_i s_i² / sum_i w_i,   w_i = the gain of component i,
///   log q ← log q + (Δt / T_l) min(u - 1, 8),
///
/// a step up the likelihood of s, with E u = 1 where it rests.
///   At rest, z is the noise of planes that hardly changes the estimate: u < 1, and q falls to its
/// floor. In constant acceleration z keeps its sign, s adds up, and q rises until the lag is within
/// what q itself predicts. A jerk makes one z large: q rises by up to 8 Δt / T_l in a window, and
/// the poses of the window, which are still free, follow.
///   It cannot confirm itself: a stiff prior makes the expected variance small in the same measure,
/// so the lag that it causes counts more. And nothing is learnt where the points tell nothing:
/// there w is near 0.
/// Idea: R. Mehra, On the identification of variances and adaptive Kalman filtering, 1970.
class MotionPrior {
 public:
  explicit MotionPrior(const MotionPriorOptions& options);

  /// [rho; theta]: m²/s³ and rad²/s³.
  const Vector6d& density() const { return density_; }

  /// Ties the velocities of the segments by the present densities.
  void Apply(Window* window) const;

  /// Takes the newest innovation of a window that is believed; `duration_s` is that of the newest
  /// segment.
  void Learn(const Innovation& innovation, double duration_s);

 private:
  double Surprise(const Innovation& innovation, int first_component, double decay) const;

  MotionPriorOptions options_;
  Vector6d density_;
  Vector6d sum_ = Vector6d::Zero();  ///< s
};

}  // namespace trajlo
