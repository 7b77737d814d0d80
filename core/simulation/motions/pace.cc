// SPDX-License-Identifier: MIT
#include "core/simulation/motions/pace.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/simulation/motions/smooth.h"

namespace trajlo::simulation {

namespace {

/// How long an acceleration takes to set in or to fade: bounds the jerk.
constexpr double kOnset = 0.6;

/// The share of a change of speed that is done after `t_s`. The change lasts `lasts_s` + kOnset,
/// and its acceleration is constant but for the onset and the end.
double Progress(double t_s, double lasts_s) {
  const double begun = SmoothStepIntegral(t_s / kOnset);
  const double ended = SmoothStepIntegral((t_s - lasts_s) / kOnset);
  return (begun - ended) * kOnset / lasts_s;
}

}  // namespace

double StartRamp(const MotionConfig& config, double t_s, double ramp_s) {
  return config.moving_start ? 1.0 : SmoothStep((t_s - config.rest_s) / ramp_s);
}

double Pace(const MotionConfig& config, double t_s, double ramp_s) {
  if (config.acceleration_mps2 == 0.0) return StartRamp(config, t_s, ramp_s);
  const double rise_s = config.speed_mps / config.acceleration_mps2;
  // A moving start is one that was over at time 0.
  double t = config.moving_start ? std::max(0.0, t_s) + rise_s + kOnset : t_s - config.rest_s;
  if (t <= 0.0) return 0.0;
  if (config.cruise_s == 0.0) return Progress(t, rise_s);
  const double fall_s = config.speed_mps / config.braking_mps2;
  const double brakes_at = rise_s + kOnset + config.cruise_s;
  const double stands_at = brakes_at + fall_s + kOnset;
  t = std::fmod(t, stands_at + config.stop_s);
  return t < stands_at ? std::max(0.0, Progress(t, rise_s) - Progress(t - brakes_at, fall_s)) : 0.0;
}

void CheckPace(const MotionConfig& config) {
  if (!(config.acceleration_mps2 >= 0.0 && config.cruise_s >= 0.0 && config.stop_s >= 0.0)) {
    throw std::invalid_argument(
        "motion.acceleration_mps2, motion.cruise_s and motion.stop_s must not be negative");
  }
  if (config.cruise_s == 0.0) return;
  if (!(config.acceleration_mps2 > 0.0 && config.braking_mps2 > 0.0)) {
    throw std::invalid_argument(
        "motion.cruise_s, which is the time between start and stop, needs "
        "motion.acceleration_mps2 and motion.braking_mps2 above 0");
  }
}

}  // namespace trajlo::simulation
