// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/window/window.h"

namespace trajlo {

/// How the points of a segment lie on the map.
struct MapAgreement {
  /// Share of all points that lie on planes of the map.
  double on_map = 0.0;
  /// Of the points that have a plane, the share that lies on it, in the direction in which it is
  /// least: a wrong place often agrees with the floor, and not with the walls. Over the normals n
  /// of these points, it is the least of uᵀ (Σ_on n nᵀ + c I) u / uᵀ (Σ n nᵀ + c I) u for any u.
  /// With c = 100, a direction that only a few points face says little.
  double worst = 1.0;
};
MapAgreement AgreementOf(const Window& window, const Segment& segment);

}  // namespace trajlo
