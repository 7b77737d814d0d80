// SPDX-License-Identifier: MIT
#include "core/odometry/window/interval_smoother.h"

#include <algorithm>
#include <utility>

#include "core/odometry/window/step_size.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

/// Where the body is followed, a pose moves by millimetres after the one before it has left.
constexpr StepSize kJump = {0.05, 0.02};

/// A pose, and its velocity [rho; theta] per second, body frame.
struct MovingPose {
  SE3 T_world_body;
  Vector6d velocity;
};

/// From `begin` on at its velocity, corrected by a cubic that ends at `end` after `duration_s`. It
/// is the mean of white noise on acceleration between the two. Position and attitude are corrected
/// by themselves, in the world: what turned unseen did not turn about the origin of the world.
SE3 Cubic(const MovingPose& begin, const MovingPose& end, double duration_s, double t_s) {
  const SE3 T_without = begin.T_world_body * se3::Exp(duration_s * begin.velocity);
  const auto world_velocity = [](const SE3& T, const Vector6d& velocity) {
    Vector6d v;
    v << T.q * velocity.head<3>(), T.q * velocity.tail<3>();
    return v;
  };
  Vector6d correction;
  correction << end.T_world_body.t - T_without.t,
      so3::Log(end.T_world_body.q * T_without.q.conjugate());
  const Vector6d rate =
      world_velocity(end.T_world_body, end.velocity) - world_velocity(T_without, begin.velocity);
  const double s = t_s / duration_s;
  const Vector6d now = s * s * (3.0 - 2.0 * s) * correction + s * s * (s - 1.0) * duration_s * rate;
  SE3 T = begin.T_world_body * se3::Exp(t_s * begin.velocity);
  T.t += now.head<3>();
  T.q = (so3::Exp(now.tail<3>()) * T.q).normalized();
  return T;
}

/// They are found anew from other poses.
void ForgetPlanes(Segment* segment) {
  segment->association = {};
  segment->points.clear();
  segment->linearization.reset();
}

}  // namespace

double IntervalSmoother::Duration_s() const {
  return Seconds(stretch_.EndNs() - stretch_.begin_ns);
}

void IntervalSmoother::AddPose(const Window& window, unsigned flags, const Matrix6d& covariance) {
  if (is_empty()) {
    stretch_ = Window();
    stretch_.begin_ns = window.begin_ns;
    stretch_.T_world_begin = window.T_world_begin;
    stretch_.prior = window.prior;
    last_jump_ = 0;
  } else {
    Meet(window);
  }
  leaving_.push_back({{window.begin_ns, SE3(), flags}, covariance});
}

void IntervalSmoother::Meet(const Window& newest) {
  Segment& last = stretch_.segments.back();
  const LinearizedRegistration as_left = {stretch_.Pose(stretch_.size() - 1), last.T_world_end,
                                          last.registration};
  if (MeasureStep(last.T_world_end, newest.T_world_begin).IsWithin(kJump)) {
    last.registration = as_left.At(as_left.T_world_begin, newest.T_world_begin);
  } else {
    last_jump_ = stretch_.size();
    last.registration = {};  // What its points said, they said of another place.
  }
  last.T_world_end = newest.T_world_begin;
}

void IntervalSmoother::AddSegment(Segment segment) {
  segment.cloud.map_points = {};
  ForgetPlanes(&segment);
  stretch_.segments.push_back(std::move(segment));
}

void IntervalSmoother::AddGap(std::int64_t end_ns) {
  Segment gap;
  gap.cloud.begin_ns = stretch_.EndNs();
  gap.cloud.end_ns = end_ns;
  gap.T_world_end = Plus(stretch_.EndPose(), gap.Duration_s() * stretch_.EndVelocity());
  stretch_.segments.push_back(std::move(gap));
}

Window IntervalSmoother::Join(const Window& newest) const {
  Window joined = stretch_;
  for (const Segment& segment : newest.segments) {
    joined.segments.push_back(segment);
    ForgetPlanes(&joined.segments.back());
  }
  joined.noise = newest.noise;
  joined.kernel_axes = newest.kernel_axes;
  return joined;
}

Window IntervalSmoother::JoinInterpolated(const Window& newest) const {
  Window joined = Join(newest);
  const int last = std::max(last_jump_, 1);
  const MovingPose begin = {joined.T_world_begin, joined.Velocity(0)};
  const MovingPose end = {joined.Pose(last), joined.Velocity(std::min(last, joined.size() - 1))};
  const auto since_begin_s = [&](int k) {
    return Seconds(joined.At(k - 1).cloud.end_ns - joined.begin_ns);
  };
  for (int k = 1; k < last; ++k) {
    joined.At(k - 1).T_world_end = Cubic(begin, end, since_begin_s(last), since_begin_s(k));
  }
  return joined;
}

void IntervalSmoother::SetPoses(const Window& joined) { stretch_.SetPoses(joined.Poses()); }

LeavingPose IntervalSmoother::TakeOldest(const MarginalizationOptions& options,
                                         const MotionPrior& motion_prior) {
  LeavingPose oldest = leaving_.front();
  oldest.pose.T_world_body = stretch_.T_world_begin;
  leaving_.erase(leaving_.begin());
  // As the oldest of its window, each segment lost what tied it to the one before.
  motion_prior.Apply(&stretch_);
  Marginalize(options, &stretch_);
  last_jump_ = std::max(last_jump_ - 1, 0);
  return oldest;
}

std::vector<LeavingPose> IntervalSmoother::TakeAll() {
  std::vector<LeavingPose> all = std::move(leaving_);
  leaving_.clear();
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].pose.T_world_body = stretch_.Pose(static_cast<int>(k));
  }
  stretch_ = Window();
  last_jump_ = 0;
  return all;
}

}  // namespace trajlo
