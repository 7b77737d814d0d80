// SPDX-License-Identifier: MIT
#pragma once

#include "core/simulation/motions/motion.h"

namespace trajlo::simulation {

/// From 0 to 1 over `ramp_s` once the rest is over; 1 all the time for a moving start.
double StartRamp(const MotionConfig& config, double t_s, double ramp_s);

/// The speed along a route at `t_s` as a share of config.speed_mps, 0 to 1: a start from rest with
/// the acceleration of the configuration (over `ramp_s` if it names none), then cruising, braking
/// and standing in turn if it stops now and then. The acceleration sets in over 0.6 s.
double Pace(const MotionConfig& config, double t_s, double ramp_s);

/// Throws std::invalid_argument for stops without an acceleration or a deceleration.
void CheckPace(const MotionConfig& config);

}  // namespace trajlo::simulation
