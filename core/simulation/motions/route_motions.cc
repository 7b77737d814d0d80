// SPDX-License-Identifier: MIT
// The motions that follow a route of the scene: walk, flight and drive.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/simulation/motions/motion_makers.h"
#include "core/simulation/motions/pace.h"
#include "core/simulation/motions/quintic_spline.h"
#include "core/simulation/motions/smooth.h"

namespace trajlo::simulation {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

constexpr double kGravity = 9.81;
constexpr double kRadPerDeg = M_PI / 180.0;

Quaterniond FromYawPitchRoll(double yaw, double pitch, double roll) {
  return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll, Vector3d::UnitX());
}

/// Braking with 1.5 m/s² before the end of an open route, and speeding up again after it.
double SpeedBeforeTurn(double distance_m) { return std::sqrt(2.0 * 1.5 * distance_m + 0.06); }

/// Position and heading along a route at a given speed: samples the route at even times, and takes
/// the samples as control points of a spline.
QuinticSpline FollowRoute(const RoutePath& path, double dt_s, double duration_s,
                          const std::function<double(double, double)>& speed_at,
                          const std::function<double(double, double)>& z_at) {
  constexpr int kMargin = 8;
  constexpr int kSubsteps = 10;
  const int count = static_cast<int>(std::ceil(duration_s / dt_s)) + 2 * kMargin;
  double along = 0.0;
  std::vector<Vector4d> points;
  for (int k = 0; k < count; ++k) {
    const double t = (k - kMargin) * dt_s;
    const Vector3d p = path.PositionAt(along);
    points.emplace_back(p.x(), p.y(), z_at(t, p.z()), path.HeadingAt(along));
    for (int i = 0; i < kSubsteps; ++i) {
      const double speed = std::min(speed_at(t + (i + 0.5) * dt_s / kSubsteps, along),
                                    SpeedBeforeTurn(path.DistanceToTurn(along)));
      along += speed * dt_s / kSubsteps;
    }
  }
  return {-kMargin * dt_s, dt_s, std::move(points)};
}

/// A control point acts up to three intervals before its time: ramps that shape control points
/// start that much later, so that the rest is exact.
constexpr double kSplineReach = 3.0;

/// The speed of somebody who is never quite even.
double Uneven(const MotionConfig& config, double t_s) {
  return config.speed_mps * (1.0 + config.unevenness * std::sin(2.0 * M_PI * 0.09 * t_s));
}

/// The speed at which a bend costs 2.5 m/s² sideways.
double SpeedInBend(const RoutePath& path, double along_m) {
  constexpr double kLook = 14.0;
  const double turn =
      path.HeadingAt(along_m + kLook) - path.HeadingAt(std::max(0.0, along_m - kLook));
  return std::sqrt(2.5 / std::max(1e-3, std::abs(turn) / (2.0 * kLook)));
}

/// The speed that leaves room to brake with 2.5 m/s² before the bends ahead, and that can have been
/// gained with `acceleration_mps2` since those behind.
double SpeedAboutBends(const RoutePath& path, double along_m, double acceleration_mps2) {
  constexpr int kReach_m = 60;
  double squared = std::numeric_limits<double>::infinity();
  for (int ahead_m = -kReach_m; ahead_m <= kReach_m; ++ahead_m) {
    const double bend = SpeedInBend(path, along_m + ahead_m);
    const double rate = ahead_m < 0 ? acceleration_mps2 : 2.5;
    squared = std::min(squared, bend * bend + 2.0 * rate * std::abs(ahead_m));
  }
  return std::sqrt(squared);
}

}  // namespace

PoseFunction MakeWalk(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                      std::uint64_t seed) {
  constexpr double kDt = 0.3;
  const RoutePath path(routes.walk, 0.8);
  const QuinticSpline spline = FollowRoute(
      path, kDt, duration_s,
      [&](double t, double) {
        return Uneven(config, t) * Pace(config, t - kSplineReach * kDt, 1.5);
      },
      [&](double, double z) { return z + config.height_m; });
  const double s = config.shake;
  const double step_hz = 1.5 + 0.3 * config.speed_mps;
  const Jitter look(seed, 1, 0.1, 0.35, s * 25.0 * kRadPerDeg);
  const Jitter nod(seed, 2, 0.2, 0.6, s * 6.0 * kRadPerDeg);
  const Jitter lean(seed, 3, 0.2, 0.6, s * 5.0 * kRadPerDeg);
  const std::vector<Jitter> hand = {{seed, 4, 2.0, 6.0, s * 0.8 * kRadPerDeg},
                                    {seed, 5, 2.0, 6.0, s * 0.8 * kRadPerDeg},
                                    {seed, 6, 2.0, 6.0, s * 0.8 * kRadPerDeg},
                                    {seed, 7, 0.3, 2.5, s * 0.02},
                                    {seed, 8, 0.3, 2.5, s * 0.02},
                                    {seed, 9, 0.3, 2.5, s * 0.02}};
  return [=](double t) {
    const double on = StartRamp(config, t, 1.5);
    const Vector4d base = spline.Value(t);
    const double step = 2.0 * M_PI * step_hz * t;
    // The body bobs with every step and sways with every second one.
    const double bob = s * 0.02 * std::sin(step);
    const double sway = s * 0.02 * std::sin(0.5 * step);
    const double yaw = base.w() + on * (look(t) + hand[0](t));
    const double pitch = on * (nod(t) + hand[1](t) + s * 1.0 * kRadPerDeg * std::sin(step + 0.7));
    const double roll = on * (lean(t) + hand[2](t) + s * 1.5 * kRadPerDeg * std::sin(0.5 * step));
    const Vector3d offset(hand[3](t) - sway * std::sin(base.w()),
                          hand[4](t) + sway * std::cos(base.w()), hand[5](t) + bob);
    return SE3(FromYawPitchRoll(yaw, pitch, roll), base.head<3>() + on * offset);
  };
}

PoseFunction MakeFlight(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed) {
  constexpr double kDt = 0.25;
  constexpr double kStandHeight = 0.3;  // Of the body above the ground, on its legs.
  const RoutePath path(routes.fly, 2.5);
  const double floor_z = routes.ground_z_m + kStandHeight;
  // Landing mirrors the start: everything is over one second before the end.
  const auto until_landed = [=](double t, double ramp_s) {
    return config.landing ? SmoothStep((duration_s - 1.0 - t) / ramp_s) : 1.0;
  };
  const QuinticSpline spline = FollowRoute(
      path, kDt, duration_s,
      [&](double t, double) {
        // Away from the spot once it has climbed a little.
        const double late = t - kSplineReach * kDt - 0.25 * config.climb_s;
        return Uneven(config, t) * Pace(config, late, std::max(1.5, config.speed_mps / 2.5)) *
               until_landed(t + kSplineReach * kDt + 0.5 * config.climb_s, 2.5);
      },
      [&](double t, double z) {
        return floor_z + (z + config.raised_m - floor_z) *
                             StartRamp(config, t - kSplineReach * kDt, config.climb_s) *
                             until_landed(t + kSplineReach * kDt, config.climb_s);
      });
  const double s = config.shake;
  const double max_tilt = kRadPerDeg * config.max_tilt_deg;
  const Jitter turn(seed, 1, 0.06, 0.3, s * 45.0 * kRadPerDeg);
  const std::vector<Jitter> wobble = {{seed, 4, 0.8, 3.0, s * 2.0 * kRadPerDeg},
                                      {seed, 5, 0.8, 3.0, s * 3.0 * kRadPerDeg},
                                      {seed, 6, 0.8, 3.0, s * 3.0 * kRadPerDeg},
                                      {seed, 7, 0.8, 2.5, s * 0.022},
                                      {seed, 8, 0.8, 2.5, s * 0.022},
                                      {seed, 9, 0.8, 2.5, s * 0.022}};
  return [=](double t) {
    const double on = StartRamp(config, t, 1.0) * until_landed(t, 1.0);
    const Vector4d base = spline.Value(t);
    const Vector4d a = spline.Acceleration(t);
    const double yaw = base.w() + on * (turn(t) + wobble[0](t));
    // A multirotor tilts its thrust to accelerate; tanh keeps the tilt below the limit, smoothly.
    const double forward = std::cos(yaw) * a.x() + std::sin(yaw) * a.y();
    const double left = -std::sin(yaw) * a.x() + std::cos(yaw) * a.y();
    const double pitch = max_tilt * std::tanh(std::atan(forward / kGravity) / max_tilt);
    const double roll = -max_tilt * std::tanh(std::atan(left / kGravity) / max_tilt);
    const Vector3d offset(wobble[3](t), wobble[4](t), wobble[5](t));
    return SE3(FromYawPitchRoll(yaw, pitch + on * wobble[1](t), roll + on * wobble[2](t)),
               base.head<3>() + on * offset);
  };
}

PoseFunction MakeDrive(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                       std::uint64_t seed) {
  constexpr double kDt = 0.4;
  const RoutePath path(routes.drive, 14.0);
  const QuinticSpline spline = FollowRoute(
      path, kDt, duration_s,
      [&](double t, double along) {
        const double pace = Pace(config, t - kSplineReach * kDt, 4.0);
        if (config.acceleration_mps2 == 0.0) {
          return std::min(Uneven(config, t), SpeedInBend(path, along)) * pace;
        }
        return std::min(Uneven(config, t) * pace,
                        SpeedAboutBends(path, along, config.acceleration_mps2));
      },
      [&](double, double z) { return z + config.height_m; });
  const double s = config.shake;
  const Jitter heave(seed, 1, 0.8, 2.5, s * 0.015);
  const Jitter pitching(seed, 2, 0.8, 3.0, s * 0.5 * kRadPerDeg);
  const Jitter rolling(seed, 3, 0.8, 3.0, s * 0.5 * kRadPerDeg);
  return [=](double t) {
    const double on = StartRamp(config, t, 4.0);
    const Vector4d base = spline.Value(t);
    const Vector4d a = spline.Acceleration(t);
    const double forward = std::cos(base.w()) * a.x() + std::sin(base.w()) * a.y();
    const double left = -std::sin(base.w()) * a.x() + std::cos(base.w()) * a.y();
    // On its springs a car dives when it brakes and leans out of a bend: about 0.6° at 2 m/s².
    const double pitch = -0.005 * forward + on * pitching(t);
    const double roll = 0.005 * left + on * rolling(t);
    return SE3(FromYawPitchRoll(base.w(), pitch, roll),
               base.head<3>() + Vector3d(0.0, 0.0, on * heave(t)));
  };
}

}  // namespace trajlo::simulation
