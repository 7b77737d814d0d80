// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/solvers/solver_options.h"
#include "core/odometry/window/association.h"

namespace trajlo {

struct InitialMotion {
  /// The body's twist over the whole first interval: T(alpha) = Exp(alpha tau).
  Vector6d tau = Vector6d::Zero();
  /// Share of the second half's points that lie on planes of the first half under tau, and under
  /// the hypothesis that the sensor stood still.
  double agreement = 0.0;
  double agreement_at_rest = 0.0;
};

/// Finds how the sensor moved during the first interval from nothing but the interval itself: the
/// points of its second half, each at its own time on Exp(alpha tau), are registered to those of
/// its first half, which move with the same tau. A wrong tau blurs the first half by a third of
/// what it displaces the second, so each round leaves about a third of the error. The voxels start
/// coarse and shrink. `weights` gives the robust kernel.
InitialMotion EstimateInitialMotion(const SegmentCloud& cloud, const MapPyramidOptions& map_options,
                                    const WeightOptions& weights, ThreadPool* threads);

}  // namespace trajlo
