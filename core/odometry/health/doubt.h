// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "core/odometry/health/agreement.h"
#include "core/odometry/health/window_statistics.h"
#include "core/odometry/window/window.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {

/// Doubts the place of a body that its points did not hold for so long that it may have left the
/// planes it was on; also where it jumps, and behind a pause, if the first window there does not
/// settle. It may settle on planes to which it does not belong, and a map that grew there would
/// prove it right. So poses stay flagged, and the map does not grow, until the points agree with it
/// in all directions as well as they did before. Where all that was wrong is a jump, or that the
/// points left a direction open, the map grows with what is new to it: a fast body would soon be
/// out of it.
class DoubtWatch {
 public:
  /// After `window` was judged; `density` is that of the acceleration, see MotionPrior.
  void Update(const Window& window, const WindowStatistics& statistics, const Vector6d& density);

  /// Why the newest pose is in doubt: flags of a window, or 0.
  unsigned flags() const { return flags_; }
  /// Points hold the newest pose, and nothing speaks against it.
  bool IsSure() const { return is_held_ && flags_ == 0; }
  /// How far the body may be from where it seems to be, while that is in doubt and the
  /// newest window has something to look for: its points hold it somewhere, or contradict the map.
  /// Three standard deviations of the motion that was not seen.
  std::optional<StepSize> Reach(double agreement) const;
  /// The axis about which the body may have turned unseen: the direction that nearly all planes
  /// faced since the doubt began, if they did.
  const std::optional<Eigen::Vector3d>& open_axis_world() const { return open_axis_world_; }
  /// For how long the place has been in doubt at `t_ns`.
  double Age_s(std::int64_t t_ns) const { return flags_ == 0 ? 0.0 : Seconds(t_ns - began_ns_); }
  /// The body was found at `t_ns`: no doubt is left, and what was unseen before does not count.
  void Dispel(std::int64_t t_ns);
  /// Whether the newest points lie on the map much worse than usual; `agreement` is their
  /// MapAgreement::worst.
  bool IsContradicted(double agreement) const;
  /// Whether the points of a segment may extend the map.
  bool MayEnterMap(const Window& window, const Segment& segment) const;

 private:
  /// Flags; 0 if the newest pose is held.
  unsigned WhyUnheld(const Window& window, const WindowStatistics& statistics,
                     const Vector6d& density) const;
  /// The newest pose is in doubt, since it or since earlier.
  void Doubt(unsigned unheld, const Window& window, const Vector6d& density);
  bool MayHaveMoved(std::int64_t t_ns, const Vector6d& density) const;
  double UsualAgreement() const;
  /// At least these shares, of all points on the map and of the usual agreement.
  bool Agrees(const Window& window, const Segment& segment, double on_map, double of_usual) const;
  bool AllAgree(const Window& window) const;

  unsigned flags_ = 0;
  unsigned causes_ = 0;                  ///< All flags since the doubt began.
  std::int64_t began_ns_ = 0;            ///< When the doubt began.
  bool is_held_ = false;                 ///< Whether the points held the newest window.
  Vector6d density_ = Vector6d::Zero();  ///< By then: wrong windows raise it.
  double unseen_s_ = 0.0;                ///< The longest time without a hold since the doubt began.
  std::optional<Eigen::Vector3d> open_axis_world_;
  std::optional<std::int64_t> held_until_ns_;
  std::optional<double> usual_agreement_;  ///< MapAgreement::worst, of late, without doubt.
};

}  // namespace trajlo
