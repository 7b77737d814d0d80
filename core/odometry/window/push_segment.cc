// SPDX-License-Identifier: MIT
#include "core/odometry/window/push_segment.h"

#include <utility>

#include "core/odometry/window/marginalize.h"

namespace trajlo {
namespace {

/// How well the velocity at the start of a window is known. It holds only the first segment.
constexpr double kBeginVelocitySigma_m_s = 3.0;
constexpr double kBeginVelocitySigma_rad_s = 3.0;

SmoothnessTerm BeginVelocity(const Vector6d& velocity, double duration_s) {
  SmoothnessTerm term;
  term.tau_expected = velocity * duration_s;
  term.sqrt_information.head<3>().setConstant(1.0 / (kBeginVelocitySigma_m_s * duration_s));
  term.sqrt_information.tail<3>().setConstant(1.0 / (kBeginVelocitySigma_rad_s * duration_s));
  return term;
}

}  // namespace

Window MakeWindow(std::int64_t begin_ns, const SE3& T_world_begin) {
  Window window;
  window.begin_ns = begin_ns;
  window.T_world_begin = T_world_begin;
  window.prior = AnchorOf(T_world_begin);
  return window;
}

void PushSegment(SegmentCloud cloud, const Vector6d& velocity, Deskewing deskewing,
                 Window* window) {
  Segment segment;
  segment.cloud = std::move(cloud);
  const double duration_s = segment.Duration_s();
  segment.T_world_end = Plus(window->EndPose(), velocity * duration_s);
  if (window->size() == 0) segment.motion = BeginVelocity(velocity, duration_s);
  if (deskewing == Deskewing::kPredicted) DeskewToEnd(velocity * duration_s, &segment.cloud);
  window->segments.push_back(std::move(segment));
}

}  // namespace trajlo
