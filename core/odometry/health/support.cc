// SPDX-License-Identifier: MIT
#include "core/odometry/health/support.h"

#include <cmath>

#include "core/odometry/segments/choose_evenly.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Fewer points than this hold no pose.
constexpr double kHandful = 20.0;
/// About this many are asked.
constexpr std::size_t kAsked = 256;
/// Of the points that have a plane, this share lies on it, if the pose is right. If it is wrong by
/// more than a point's distance from its plane may be, a third does.
constexpr double kAgreeing = 0.5;
/// What a registration from the prediction bridges, for three standard deviations of it.
constexpr double kBridged_m = 1.0;
constexpr double kBridged_rad = 0.45;

}  // namespace

bool IsUnsupported(const Window& window, const Segment& segment) {
  // What most points say, some of them say, too.
  const std::size_t stride = StrideForAbout(kAsked, segment.points.size());
  std::size_t asked_on_plane = 0;
  ForEachPoint(window, segment, stride, [&](const RegistrationPoint&, bool is_on_plane) {
    asked_on_plane += is_on_plane ? 1 : 0;
  });
  const auto on_plane = static_cast<double>(stride * asked_on_plane);
  return on_plane < kHandful || on_plane < kAgreeing * static_cast<double>(segment.points.size());
}

bool SeesNothing(const Segment& segment) {
  return static_cast<double>(segment.points.size()) < kHandful;
}

bool SilenceUnsupported(Window* window) {
  bool has_silenced = false;
  for (Segment& segment : window->segments) {
    if (!IsUnsupported(*window, segment)) continue;
    for (RegistrationPoint& point : segment.points) {
      has_silenced = has_silenced || point.weight > 0.0;
      point.weight = 0.0;
    }
    segment.linearization.reset();
  }
  return has_silenced;
}

bool SupportWatch::IsBlind(std::int64_t t_ns, const Vector6d& density) const {
  if (!was_supported_) return false;
  return MayHaveMoved(density, Seconds(t_ns - supported_until_ns_), kBridged_m, kBridged_rad);
}

double UnseenSigma(double density, double duration_s) {
  return std::sqrt(density * duration_s * duration_s * duration_s / 3.0);
}

bool MayHaveMoved(const Vector6d& density, double duration_s, double distance_m, double angle_rad) {
  return 3.0 * UnseenSigma(density[0], duration_s) > distance_m ||
         3.0 * UnseenSigma(density[3], duration_s) > angle_rad;
}

}  // namespace trajlo
