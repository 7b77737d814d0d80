// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/trajectory/final_poses.h"
#include "core/odometry/weights/motion_prior.h"
#include "core/odometry/window/marginalize.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// A fixed-interval smoother over what has left the window while it was in doubt where the body is.
/// Then the motion prior carries the poses, or wrong planes do, and they leave before the points
/// hold the body again. When they do, both ends of the stretch are known, and it can be estimated
/// once more: a body that nothing held for T is off by q T³ / 3 in the mean square at the end, if
/// only the begin is known, but by at most q T³ / 192 anywhere, if both are.
///
/// It is a window of its own, from the first pose that left in doubt to the first one of the
/// present window. Its prior is that of the window which the first pose left. Each pose stands
/// where its last window had it: the poses after a jump are right, those before it wrong.
class IntervalSmoother {
 public:
  bool is_empty() const { return leaving_.empty(); }
  std::int64_t EndNs() const { return stretch_.EndNs(); }
  double Duration_s() const;
  /// Whether poses moved clearly after those before them had left: there is something to estimate.
  bool has_jumped() const { return last_jump_ > 0; }

  /// The first pose of `window`, before it leaves; the poses before it stay.
  void AddPose(const Window& window, unsigned flags, const Matrix6d& covariance);
  /// The segment that left with it.
  void AddSegment(Segment segment);
  /// In its place, where the window came to an end: the motion until `end_ns` was not measured.
  void AddGap(std::int64_t end_ns);

  /// Ends the stretch where `newest`, the present window, begins by now.
  void Meet(const Window& newest);
  /// The stretch and the segments of `newest`, which it meets, in one window; nothing is
  /// associated.
  Window Join(const Window& newest) const;
  /// The same, but up to the last jump with the poses that are likeliest without any points: a
  /// cubic between the poses and velocities at both ends.
  Window JoinInterpolated(const Window& newest) const;
  /// How many of the segments are those of the stretch: the first ones.
  int segments() const { return stretch_.size(); }
  /// Takes the poses of the stretch from a solved window of the two together.
  void SetPoses(const Window& joined);

  /// The oldest pose leaves; what it says about the others becomes part of the prior.
  LeavingPose TakeOldest(const MarginalizationOptions& options, const MotionPrior& motion_prior);
  std::vector<LeavingPose> TakeAll();

 private:
  Window stretch_;
  std::vector<LeavingPose> leaving_;  ///< Times, flags and covariances: poses are in stretch_.
  int last_jump_ = 0;                 ///< The pose that jumped last; 0 if none did.
};

}  // namespace trajlo
