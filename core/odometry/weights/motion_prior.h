// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "core/odometry/weights/innovation.h"
#include "core/odometry/weights/velocity_persistence.h"
#include "core/odometry/window/window.h"
#include "core/options/describe.h"

namespace trajlo {

enum class MotionPriorKind {
  kWhiteNoiseAcceleration,  ///< Ties neighbouring segments; see WhiteNoiseAccelerationTerm.
  kPseudoVelocity,          ///< The paper's: ties a segment to the last estimate of the one before.
  kNone,                    ///< Nothing ties segments, for comparison.
};

struct MotionPriorOptions {
  MotionPriorKind kind = MotionPriorKind::kWhiteNoiseAcceleration;
  double translation_m2_s3 = 0.5;
  double rotation_rad2_s3 = 0.5;
  bool self_tuning = true;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "kind", kind,
      Names<MotionPriorKind>{{"white_noise_acceleration", MotionPriorKind::kWhiteNoiseAcceleration},
                             {"pseudo_velocity", MotionPriorKind::kPseudoVelocity},
                             {"none", MotionPriorKind::kNone}},
      "White noise on acceleration, which ties neighbouring segments; the paper's "
      "pseudo-velocity, which ties a segment to the last estimate of the one before; or nothing, "
      "for comparison (the motion still predicts where a solve begins).");
    d(OptionFor::kUsers, "self_tuning", self_tuning,
      "Lets the prior follow the motion: the densities of its acceleration (expert.motion_prior), "
      "and how long the body keeps a velocity. false keeps the densities, and all velocities.");
    d(OptionFor::kExperts, "translation_m2_s3", translation_m2_s3, Range<double>{1e-9, 1e4},
      "Spectral density of the acceleration: how freely the body moves. The translations of "
      "neighbouring segments of length dt differ by a variance of 2/3 of it times dt^3. "
      "Self-tuning begins here and never goes below.");
    d(OptionFor::kExperts, "rotation_rad2_s3", rotation_rad2_s3, Range<double>{1e-9, 1e4},
      "The same for rotation.");
  }
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
///   log q ← log q + (Δt / T_l) min(u / v - 1, 8),
///
/// a step up the likelihood of s, with E u = v where it rests. v = 1 if the noise of the points is
/// as large as assumed. It is mostly smaller: sigma_m is on the safe side. Then z² has a mean below
/// 1, and a sum of z that are independent is smaller in the same measure: v is the mean of z² over
/// T_l, between 0.2 and 1, or the mean of min(z², 4) over the last two seconds if that is more. (A
/// jerk makes z² large, too, but not for long. And not for rotation, where it brought nothing, and
/// made runs at 35 rad/s too uncertain.)
///
/// On rough ground, or where each segment sees one side only, the noise is larger than assumed: all
/// points of a segment share errors of their planes. Then z² is large and the sums are not, since
/// such errors change their sign. So the variance of the points gets a factor k >= 1,
///
///   log k ← log k + (Δt / T_k) (min(z², 4) - max(1, u)).
///
/// At rest, z is the noise of planes that hardly changes the estimate: u < 1, and q falls to its
/// floor. In constant acceleration z keeps its sign, s adds up, and q rises until the lag is within
/// what q itself predicts. A jerk makes one z large: log q rises by up to 8 Δt / T_l in a window,
/// and the poses of the window, which are still free, follow.
///
/// It cannot confirm itself: a stiff prior makes the expected variance small in the same measure,
/// so the lag that it causes counts more. And nothing is learnt where the points tell nothing:
/// there w is near 0.
///
/// The velocity that this acceleration changes is the one before, or returns to its mean: see
/// VelocityPersistence.
///
/// Idea: R. Mehra, On the identification of variances and adaptive Kalman filtering, 1970.
class MotionPrior {
 public:
  explicit MotionPrior(const MotionPriorOptions& options);

  /// [rho; theta]: m²/s³ and rad²/s³.
  const Vector6d& density() const { return density_; }

  const VelocityPersistence& persistence() const { return persistence_; }

  /// How far the body strays within a segment from the constant twist between its control poses,
  /// the mean square. White acceleration of density q leaves q t² (Δt - t)² / (3 Δt) at t, and
  /// q Δt³ / 90 on average. None for a scan at one instant, nor for a pseudo-velocity, which takes
  /// the twist for constant.
  double Bend_m2(const SegmentCloud& cloud) const;

  /// k: by how much the variance of the points is larger than assumed.
  double noise_factor() const { return std::exp(log_noise_factor_); }

  /// The factor between the squared errors of the poses and the covariances of their windows: the
  /// mean of z² over T_l, of translation and rotation together; 1 before there is evidence.
  ///
  /// The noise of the points is set on the safe side, the motion is calmer than q at rest and at
  /// times wilder, and errors of planes move the map and the poses alike: so covariances are off by
  /// a factor, and corrections are off by the same one.
  double covariance_scale() const { return scatter_.mean(); }

  /// The velocity to expect of a segment of `duration_s` that follows those of a window,
  /// [rho; theta] per second, body frame.
  Vector6d Predict(const Window& window, double duration_s) const;

  /// Ties the velocities of the segments by the present densities.
  void Apply(Window* window) const { Apply(density_, window); }
  /// The same, but leaves rotation almost free.
  void UntieRotation(Window* window) const;

  /// Takes the newest innovation of a window that is believed; `duration_s` is that of the newest
  /// segment.
  void Learn(const Innovation& innovation, double duration_s);
  /// Takes the velocity of that segment: how long the body keeps it, see VelocityPersistence.
  void LearnPersistence(const Innovation& innovation, const Vector6d& velocity, double duration_s);

  /// Of the motion, a part was not seen: what comes is no continuation of what came before.
  void NoteGap();

  /// Takes an innovation that the densities say cannot be, and the points say is: raises them until
  /// they would have predicted as much, the likeliest value by this innovation alone.
  void Follow(const Innovation& innovation);

 private:
  void Apply(const Vector6d& density, Window* window) const;
  void LearnNoise(double scatter, double surprise, double duration_s);

  MotionPriorOptions options_;
  Vector6d density_;
  VelocityPersistence persistence_;
  Vector6d sum_ = Vector6d::Zero();  ///< s
  /// z² of translation and of rotation, averaged over T_l.
  Eigen::Vector2d scatter_ = Eigen::Vector2d::Ones();
  double lasting_scatter_ = 1.0;  ///< min(z², 4) of translation, averaged over two seconds.
  double log_noise_factor_ = 0.0;
};

}  // namespace trajlo
