// SPDX-License-Identifier: MIT
#pragma once

#include <deque>

#include "manifolds/se3.h"

namespace trajlo {

/// How long a body keeps the velocity that it has, learnt while running: a car for many seconds,
/// one on a rope for a fifth of a second.
///
/// Let m be the mean velocity of late, and v - m what the body has beyond it. Its correlation with
/// what it was L = 0.3 s ago, as far as the points told both (w, the gains of their innovations),
///
///   rho = (mean of v_tᵀ W v_{t-L} + c) / (mean of v_{t-L}ᵀ W v_{t-L} + c),
///
/// with v less m and W = diag(w_t w_{t-L}), says what share of it is left after L, and rho^(t/L)
/// after t. c = (0.5 m/s)² holds rho near 1 until larger motions say something else: at rest,
/// velocities are noise.
///
/// Where no point holds the body along some direction, it is predicted to come back to its mean
/// velocity with this share: who swings or shakes does not fly on with the velocity of one moment.
/// This cannot confirm itself: there w is near 0, and what was learnt fades within seconds.
///
/// Of translation alone, in the body frame. (To let turn rates return brought nothing.)
class VelocityPersistence {
 public:
  /// `velocity` ([rho; theta] per second, body frame) is that of a segment of `duration_s`, `gain`
  /// the share of the predicted variance that its points took away (see Innovation).
  void Learn(const Vector6d& velocity, const Vector6d& gain, double duration_s);

  /// What comes next is later by an unknown time.
  void NoteGap() { past_.clear(); }

  /// rho: the share of the velocity beyond the mean that is left after 0.3 s.
  double share() const;
  /// The share that is left after `duration_s`, by component; 1 for rotation.
  Vector6d Over(double duration_s) const;
  /// [m; 0].
  const Vector6d& mean_velocity() const { return mean_; }

 private:
  struct Past {
    double end_s;  ///< Of the time that was learnt from.
    Eigen::Vector3d velocity, gain;
  };

  Vector6d mean_ = Vector6d::Zero();
  double mean_weight_ = 0.0;
  std::deque<Past> past_;  ///< Over the lag.
  double now_s_ = 0.0;
  /// The two means (m²/s²).
  double product_ = 0.0, square_ = 0.0;
};

}  // namespace trajlo
