// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/odometry/window/window.h"
#include "factors/plane_distances.h"

namespace trajlo {

/// Whether the points of a segment do not hold it at its present poses: most of those that have a
/// plane of the map do not lie on it, or only a handful does. So it is while a LiDAR is covered or
/// silent. Points without a plane say nothing: they may see a new part of the world.
bool IsUnsupported(const Window& window, const Segment& segment);

/// Whether hardly any point of a segment has a plane: it looked where nothing is, or nothing known.
/// Unlike points that lie beside their planes, it contradicts nothing.
bool SeesNothing(const Segment& segment);

/// Takes the weight from the points of such segments. A hand before the LiDAR moves with the body:
/// its points would hold the body still. Returns whether any of them had one. They have it again
/// when the segment asks the map for planes again.
bool SilenceUnsupported(Window* window);

/// A point within this distance is on its plane: the error of a prediction after a short pause.
constexpr double kOnPlane_m = 0.2;

/// Calls f(point, is_on_plane) for every `stride`-th point of a segment that has a plane.
template <typename F>
void ForEachPoint(const Window& window, const Segment& segment, std::size_t stride, F f) {
  const auto k = static_cast<int>(&segment - window.segments.data());
  ForEachDistance(segment.points, window.Motion(k), stride,
                  [&](const RegistrationPoint& point, double distance_m) {
                    f(point, std::abs(distance_m) < kOnPlane_m);
                  });
}

/// Notices when the motion prior has carried the window for too long. Its uncertainty grows with
/// sqrt(q t³ / 3); once it is more than a registration from the prediction bridges, the place must
/// be looked for. See ReturnSearch.
class SupportWatch {
 public:
  /// A map begins, of what was seen until `end_ns`.
  void Begin(std::int64_t end_ns) { supported_until_ns_ = end_ns; }
  /// A segment that ends at `end_ns` was held by its points.
  void Supported(std::int64_t end_ns) {
    supported_until_ns_ = end_ns;
    was_supported_ = true;
  }
  /// False: there is no place yet that could be found again.
  bool was_supported() const { return was_supported_; }

  std::int64_t supported_until_ns() const { return supported_until_ns_; }
  /// Whether the prediction for `t_ns` is too uncertain to start from; `density` is that of the
  /// acceleration, see MotionPrior.
  bool IsBlind(std::int64_t t_ns, const Vector6d& density) const;

 private:
  std::int64_t supported_until_ns_ = 0;
  bool was_supported_ = false;
};

/// Standard deviation of a body's position (m) or attitude (rad) that moved unseen for `duration_s`
/// by white noise on acceleration of spectral density `density` (m²/s³ or rad²/s³).
double UnseenSigma(double density, double duration_s);

/// Whether three of them are more than `distance_m` or `angle_rad`; `density` is that of the
/// acceleration, see MotionPrior.
bool MayHaveMoved(const Vector6d& density, double duration_s, double distance_m, double angle_rad);

}  // namespace trajlo
