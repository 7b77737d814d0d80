// SPDX-License-Identifier: MIT
// The walks with something sudden in between: bursts and glances.
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/simulation/motions/motion_makers.h"
#include "core/simulation/motions/smooth.h"
#include "core/simulation/random/counter_random.h"

namespace trajlo::simulation {

using Eigen::Vector3d;

namespace {

constexpr double kRadPerDeg = M_PI / 180.0;

/// When the first sudden thing happens. Throws std::invalid_argument if they would never end.
double FirstTime(const MotionConfig& config) {
  if (!(config.burst_every_s > 0.0 && config.glance_s > 0.0)) {
    throw std::invalid_argument("motion.burst_every_s and motion.glance_s must be positive");
  }
  return config.moving_start ? 0.5 : config.rest_s + 1.5;
}

/// A look to the side that stays for a moment, or a shake of the head.
struct Glance {
  double t_s;
  double angle_rad;
  double turn_s;
  double hold_s;
  /// 0 for a look to the side.
  double shake_hz;

  double AngleAt(double t) const {
    const double since = t - t_s;
    const double there = SmoothStep(since / turn_s) * SmoothStep((duration_s() - since) / turn_s);
    if (there == 0.0 || shake_hz == 0.0) return angle_rad * there;
    return angle_rad * there * std::sin(2.0 * M_PI * shake_hz * since);
  }
  double duration_s() const { return 2.0 * turn_s + hold_s; }
};

std::vector<Glance> DrawGlances(const MotionConfig& config, double duration_s, std::uint64_t seed) {
  std::vector<Glance> glances;
  CounterRandom random(seed, 0x61a9ce);
  double t = FirstTime(config);
  for (int i = 0; t < duration_s; ++i) {
    const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
    const double angle = side * kRadPerDeg * config.burst_deg;
    // Every third one is a shake, of a quarter of the angle to either side.
    if (i % 3 == 2) {
      glances.push_back({t, 0.25 * angle, 0.3, random.Uniform(0.4, 0.9), random.Uniform(1.8, 2.6)});
    } else {
      const double part = random.Uniform(0.7, 1.0);
      glances.push_back({t, part * angle, config.glance_s, random.Uniform(0.2, 0.8), 0.0});
    }
    t += glances.back().duration_s() + config.burst_every_s * random.Uniform(0.5, 1.0);
  }
  return glances;
}

}  // namespace

PoseFunction MakeBursts(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed) {
  struct Burst {
    double t_s, width_s;
    Vector3d turn, jolt;
  };
  std::vector<Burst> bursts;
  CounterRandom random(seed, 0xb0757);
  double t = FirstTime(config);
  while (t < duration_s) {
    const auto direction = [&]() -> Vector3d {
      return Vector3d(random.Gaussian(), random.Gaussian(), random.Gaussian()).normalized();
    };
    bursts.push_back({t, random.Uniform(0.08, 0.16),
                      direction() * kRadPerDeg * config.burst_deg * random.Uniform(0.5, 1.0),
                      direction() * random.Uniform(0.05, 0.15)});
    t += config.burst_every_s * random.Uniform(0.7, 1.3);
  }
  const PoseFunction walk = MakeWalk(config, routes, duration_s, seed);
  return [=](double t_s) {
    Vector3d turn = Vector3d::Zero();
    Vector3d jolt = Vector3d::Zero();
    for (const Burst& burst : bursts) {
      // A Gaussian bump: there and back again, with every derivative continuous. It is cut where it
      // is below the rounding of a double.
      const double x = (t_s - burst.t_s) / burst.width_s;
      if (std::abs(x) > 6.5) continue;
      const double bump = std::exp(-x * x);
      turn += bump * burst.turn;
      jolt += bump * burst.jolt;
    }
    const SE3 T = walk(t_s);
    return SE3(T.q * so3::Exp(turn), T.t + jolt);
  };
}

PoseFunction MakeGlances(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                         std::uint64_t seed) {
  const std::vector<Glance> glances = DrawGlances(config, duration_s, seed);
  const PoseFunction walk = MakeWalk(config, routes, duration_s, seed);
  return [=](double t_s) {
    double angle = 0.0;
    for (const Glance& glance : glances) angle += glance.AngleAt(t_s);
    // The hand is in front of the axis about which the head and the shoulders turn.
    const Vector3d from_axis(0.12, 0.0, 0.0);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
    return walk(t_s) * SE3(turn, turn * from_axis - from_axis);
  };
}

}  // namespace trajlo::simulation
