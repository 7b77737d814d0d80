// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/window/window.h"

namespace trajlo {

/// Graduated non-convexity for a window whose newest pose may be far off: after a fast turn, or
/// where nothing was seen for a while.
///
/// The robust kernel takes a point that is 0.1 m from its plane for an outlier. If the prediction
/// itself is off by more, the right planes are outliers, and the window settles on wrong ones. So
/// the kernel of each point starts as wide as the prediction may be off there, according to its
/// covariance P, and narrows from round to round:
///
///   f = (3² / 4^round) J P Jᵀ / kernel²,   weight ← weight coarseness³ / (1 + f),
///
/// with J the derivative of the point's distance by the newest pose: a point is doubted in
/// proportion to how far it may be off, and the kernel c, which is in units of sigma /
/// sqrt(weight), becomes c sqrt(1 + f). Far from its place a point takes a wrong plane, and the
/// coarser ones are less wrong: their weight, 1 / coarseness⁴ where the place is known, becomes
/// 1 / coarseness. Where the prediction is good, f is small for most points and nothing happens.
/// Idea: A. Blake, A. Zisserman, Visual Reconstruction, 1987; H. Yang et al., Graduated
/// Non-Convexity for Robust Spatial Perception, RA-L 2020.
class GraduatedKernel {
 public:
  /// Before the newest segment of `window` is associated for the first time. A prediction that is
  /// off by less than `kernel_m` is good.
  GraduatedKernel(const Window& window, double kernel_m);

  /// Widens the kernels of the newest segment's points for one round; false if most no longer need
  /// it.
  bool Widen(Segment* newest);
  /// Undoes that.
  void Restore(Segment* newest) const;

 private:
  Matrix6d reach_;  ///< (3² / 4^round) P / kernel²; zero if there is nothing to do.
  std::vector<double> weights_;
};

}  // namespace trajlo
