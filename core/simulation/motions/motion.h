// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/simulation/motions/pose_function.h"
#include "core/simulation/motions/route.h"

namespace trajlo::simulation {

/// How the body moves. A field that a kind of motion has no use for is ignored.
struct MotionConfig {
  /// walk: hand-held, along the scene's walking route.
  /// flight: take-off, flight along the flying route, landing if asked for.
  /// drive: a car along the driving route.
  /// spin: a platform at the start of the flying route that is spun up about the vertical.
  /// swing: a LiDAR on a rope there.
  /// bursts: a walk with violent turns and jolts in between.
  /// glances: a walk with quick looks to the side and shakes of the head in between.
  /// twist: T_0 Exp(t xi), a constant velocity in the body frame, from there.
  /// replay: the poses of a TUM file, joined by a cubic spline.
  /// still: it stands still.
  std::string kind = "walk";
  /// Standing still at first for this long, unless it starts in motion.
  double rest_s = 1.8;
  bool moving_start = false;
  double speed_mps = 1.2;
  /// Along a route: by how much the speed swells and ebbs, as a share of it.
  double unevenness = 0.2;
  /// Along a route: how it gains speed after the rest; 0 is an easy start, as long as suits the
  /// kind. A drive with one brakes in time before bends, and gains no more than that after them.
  double acceleration_mps2 = 0.0;
  /// Along a route: how long it keeps its speed before it brakes to a stand (0: for ever), how hard
  /// it brakes, and how long it stands before it starts again.
  double cruise_s = 0.0;
  double braking_mps2 = 0.0;
  double stop_s = 2.0;
  /// Of the body above the walking or driving route.
  double height_m = 1.3;
  /// Scales all shaking of body and hand; 0 switches it off.
  double shake = 1.0;
  /// flight: the roll and pitch that it never exceeds but for the shaking.
  double max_tilt_deg = 15.0;
  /// flight: how much higher than the route of the scene, how long climbing there takes, and
  /// whether the last seconds are a landing.
  double raised_m = 0.0;
  double climb_s = 3.0;
  bool landing = false;
  /// spin: the final rate; twist: about the vertical.
  double turn_rate_rad_s = 20.0;
  /// swing: the rope, the amplitude and the frequency at which it is driven.
  double rope_m = 1.2;
  double swing_deg = 60.0;
  double swing_hz = 0.72;
  /// bursts and glances: the largest turn, and how often.
  double burst_deg = 60.0;
  double burst_every_s = 1.5;
  /// glances: how long it takes to turn to the side.
  double glance_s = 0.4;
  /// replay: the file, in TUM format; and whether it is moved to start where the flying route does
  /// (only turned about the vertical) or keeps its coordinates.
  std::string replay_file;
  bool replay_placed = true;
};

/// The ways that a scene offers.
struct SceneRoutes {
  Route walk;
  Route drive;
  /// z is the height of the flight; take-off is from the ground under the first point.
  Route fly;
  double ground_z_m = 0.0;
};

/// Makes the motion. `duration_s` is the length of the recording (a landing ends with it); the seed
/// decides frequencies and phases of the shaking. Throws std::invalid_argument for an unknown kind,
/// and std::runtime_error for a replay file that cannot be used.
PoseFunction MakeMotion(const MotionConfig& config, const SceneRoutes& routes, double duration_s,
                        std::uint64_t seed);

/// The kinds that MakeMotion knows.
std::vector<std::string> MotionKinds();

}  // namespace trajlo::simulation
