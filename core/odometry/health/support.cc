// SPDX-License-Identifier: MIT
#include "core/odometry/health/support.h"

#include <algorithm>
#include <cmath>

#include "manifolds/se3_interpolation.h"

namespace trajlo {
namespace {

/// A point within this distance is on its plane: the error of a prediction after a short pause.
constexpr double kOnPlane_m = 0.2;
/// Fewer points than this hold no pose.
constexpr double kHandful = 20.0;
/// About so many are asked.
constexpr std::size_t kAsked = 256;
/// Of the points that have a plane, this share lies on it, if the pose is right. If it is wrong by
/// more than a point's distance from its plane may be, a third does.
constexpr double kAgreeing = 0.5;
/// What a registration from the prediction bridges, for three standard deviations of it.
constexpr double kBridged_m = 1.0;
constexpr double kBridged_rad = 0.45;

/// How many of every `stride`-th point of a segment lie on their planes.
double CountOnPlanes(const Window& window, const Segment& segment, std::size_t stride) {
  const auto k = static_cast<int>(&segment - window.segments.data());
  const SegmentMotion motion(window.Pose(k), segment.T_world_end);
  double on_plane = 0.0;
  for (std::size_t i = 0; i < segment.points.size(); i += stride) {
    const RegistrationPoint& point = segment.points[i];
    const Eigen::Vector3d p_world = motion.ToWorld(point.alpha, point.p_body_m);
    if (std::abs(point.DistanceToPlane(p_world)) < kOnPlane_m) ++on_plane;
  }
  return on_plane;
}

}  // namespace

bool IsUnsupported(const Window& window, const Segment& segment) {
  // What most points say, some of them say, too.
  const std::size_t stride = 1 + segment.points.size() / kAsked;
  const double on_plane = static_cast<double>(stride) * CountOnPlanes(window, segment, stride);
  return on_plane < kHandful || on_plane < kAgreeing * static_cast<double>(segment.points.size());
}

double ShareOnMap(const Window& window, const Segment& segment) {
  const std::size_t all = std::max<std::size_t>(segment.cloud.registration_points.size(), 1);
  return CountOnPlanes(window, segment, 1) / static_cast<double>(all);
}

bool SupportWatch::IsBlind(std::int64_t t_ns, const Vector6d& density) const {
  if (!was_supported_) return false;
  const double unseen_s = 1e-9 * static_cast<double>(t_ns - supported_until_ns_);
  return 3.0 * UnseenSigma(density[0], unseen_s) > kBridged_m ||
         3.0 * UnseenSigma(density[3], unseen_s) > kBridged_rad;
}

double UnseenSigma(double density, double duration_s) {
  return std::sqrt(density * duration_s * duration_s * duration_s / 3.0);
}

}  // namespace trajlo
