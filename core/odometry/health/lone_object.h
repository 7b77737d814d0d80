// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/window/window.h"

namespace trajlo {

/// Notices when one object alone holds a direction, and the rest of the world contradicts it: the
/// object may move along with the body. A truck ahead in a tunnel has 2 % of the points and nearly
/// all information along the way; the body seems to rest, as the truck does, and all points agree
/// with that but those that pass by.
///
/// The direction u is one that few normals of the window face. Of the planes that face it, a
/// ball around the place with most information is the object. Over the last seconds,
///   - it has nearly all of Σ weight (nᵀu)² of the points that lie on such planes, and
///   - of the other points with such planes, few lie on them: the share is less than 0.4 times that
///     of the object's own.
/// The end of a corridor is a lone object, too; but what else faces the way (doors, lamps) agrees
/// with it. Where nothing else does, nothing can tell.
class LoneObjectWatch {
 public:
  /// Takes the next window; true if what holds it may move along.
  bool IsContradicted(const Window& window);

 private:
  /// Sums over points of the newest segments which have a plane that faces the direction. They
  /// fade.
  struct Evidence {
    double points = 0.0;
    double on_plane = 0.0;     ///< Those that lie on it.
    double information = 0.0;  ///< What these tell.

    void Fade(double kept);
    double ShareOnPlane() const;
  };

  Evidence object_, others_;
  std::optional<std::int64_t> end_ns_;  ///< Of the last window.
};

}  // namespace trajlo
