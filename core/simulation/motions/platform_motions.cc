// SPDX-License-Identifier: MIT
// The motions about one spot: spin, swing, twist and still.
#include <cmath>

#include "core/simulation/motions/motion_makers.h"
#include "core/simulation/motions/pace.h"
#include "core/simulation/motions/smooth.h"

namespace trajlo::simulation {

using Eigen::AngleAxisd;
using Eigen::Vector3d;

namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

/// The integral of StartRamp from 0: the time for which the motion has been on, as a smooth
/// function.
double TimeInMotion(const MotionConfig& config, double t_s, double ramp_s) {
  return config.moving_start ? t_s : ramp_s * SmoothStepIntegral((t_s - config.rest_s) / ramp_s);
}

}  // namespace

SE3 SpotOfFlight(const SceneRoutes& routes, double height_m) {
  Vector3d position = routes.fly.points.front();
  position.z() = routes.ground_z_m + height_m;
  const Vector3d ahead = routes.fly.points[1] - routes.fly.points[0];
  return {Eigen::Quaterniond(AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vector3d::UnitZ())),
          position};
}

PoseFunction MakeSpin(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed) {
  const SE3 T_world_spot = SpotOfFlight(routes, config.height_m);
  const double s = config.shake;
  const Jitter tilt_x(seed, 1, 0.2, 0.8, s * 4.0 * kRadPerDeg);
  const Jitter tilt_y(seed, 2, 0.2, 0.8, s * 4.0 * kRadPerDeg);
  const std::vector<Jitter> drift = {
      {seed, 3, 0.05, 0.4, s * 0.3}, {seed, 4, 0.05, 0.4, s * 0.3}, {seed, 5, 0.05, 0.4, s * 0.1}};
  return [=](double t) {
    constexpr double kSpinUp = 3.0;
    constexpr double kLever = 0.08;  // The LiDAR sits off the axis.
    const double on = StartRamp(config, t, kSpinUp);
    const double angle = config.turn_rate_rad_s * TimeInMotion(config, t, kSpinUp);
    const Eigen::Quaterniond q = AngleAxisd(on * tilt_x(t), Vector3d::UnitX()) *
                                 AngleAxisd(on * tilt_y(t), Vector3d::UnitY()) *
                                 AngleAxisd(angle, Vector3d::UnitZ());
    const Vector3d axis = on * Vector3d(drift[0](t), drift[1](t), drift[2](t));
    return T_world_spot * SE3(q, axis + q * Vector3d(kLever, 0.0, 0.0));
  };
}

PoseFunction MakeSwing(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed) {
  const SE3 T_world_spot = SpotOfFlight(routes, config.height_m);
  const double s = config.shake;
  const Jitter side(seed, 1, 0.2, 0.5, s * 10.0 * kRadPerDeg);
  const Jitter twist(seed, 2, 0.2, 0.8, s * 50.0 * kRadPerDeg);
  return [=](double t) {
    const double on = StartRamp(config, t, 4.0);
    const double omega = 2.0 * M_PI * config.swing_hz;
    const double angle = on * kRadPerDeg * config.swing_deg * std::sin(omega * t);
    // The rope turns about the pivot, and the LiDAR about the rope.
    const Eigen::Quaterniond rope = AngleAxisd(angle, Vector3d::UnitY()) *
                                    AngleAxisd(on * side(t), Vector3d::UnitX()) *
                                    AngleAxisd(on * twist(t), Vector3d::UnitZ());
    const Vector3d pivot(0.0, 0.0, config.rope_m);
    return T_world_spot * SE3(rope, pivot - rope * pivot);
  };
}

PoseFunction MakeTwist(const MotionConfig& config, const SceneRoutes& routes, std::uint64_t seed) {
  const SE3 T_world_spot = SpotOfFlight(routes, config.height_m);
  Vector6d twist = Vector6d::Zero();
  twist[0] = config.speed_mps;
  twist[5] = config.turn_rate_rad_s;
  std::vector<Jitter> shaking;
  for (unsigned i = 0; i < 6; ++i) {
    const double peak = i < 3 ? 0.02 : 2.0 * kRadPerDeg;
    shaking.emplace_back(seed, i, 0.5, 2.5, config.shake * peak);
  }
  return [=](double t) {
    // The shaking sets in late: the first two seconds are a constant twist to the last digit.
    const double on = SmoothStep((t - 2.0) / 2.0);
    Vector6d shake;
    for (int i = 0; i < 6; ++i) shake[i] = on * shaking[static_cast<std::size_t>(i)](t);
    return T_world_spot * se3::Exp(TimeInMotion(config, t, 1.5) * twist) * se3::Exp(shake);
  };
}

PoseFunction MakeStill(const SceneRoutes& routes) {
  return [T_world_spot = SpotOfFlight(routes, 1.0)](double) { return T_world_spot; };
}

}  // namespace trajlo::simulation
