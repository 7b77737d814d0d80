// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/simulation/scenario.h"

/// What scenarios are put together from.
namespace trajlo::simulation {

/// The LiDARs of NTU VIRAL (brytsknguyen/slict: config/ntuviral.yaml): one horizontal, one vertical
/// that starts its sweep 37 ms later.
std::vector<LidarConfig> NtuViralRig();
/// The LiDARs of Hilti 2021. Their calibration is not public: this mounting is made up.
std::vector<LidarConfig> HiltiRig();

/// A flight with the horizontal LiDAR of NTU VIRAL.
Scenario Flight(const std::string& scene, double speed_mps, double duration_s);
/// A minute of flight at 8 m/s, with the tilt that 3 m/s² take.
Scenario FastFlight(const std::string& scene);
/// A take-off to 80 m above what is usual in the scene, and a flight up there.
Scenario Survey(const std::string& scene, const LidarConfig& lidar);
/// A slow take-off, then rising and sinking by turns with hovering.
Scenario Hover(const std::string& scene);
/// A flight through the hall at a constant velocity in the body frame.
Scenario ConstantTwist();
Scenario Walk(const std::string& scene, const LidarConfig& lidar, double duration_s);
/// Walks with something sudden in between.
Scenario Bursts(const std::string& scene, const LidarConfig& lidar);
Scenario Glances(const std::string& scene, const LidarConfig& lidar);
/// A car that is on its way when the recording starts.
Scenario Drive(const std::string& scene, const LidarConfig& lidar, double speed_mps);
/// The same on the motorway, among others.
Scenario Motorway(const LidarConfig& lidar, double speed_mps);
/// A platform or a rope at the start of the flying route.
Scenario OnTheSpot(const std::string& scene, const std::string& motion, const LidarConfig& lidar);

/// From rest to full speed and, after `cruise_s`, back to rest, again and again.
Scenario FromRest(Scenario s, double acceleration_mps2, double cruise_s, double braking_mps2);
Scenario Lasting(Scenario s, double duration_s);
Scenario TwoLidars(Scenario s, std::vector<LidarConfig> rig);
/// With the scene's moving objects.
Scenario Peopled(Scenario s);
Scenario Landing(Scenario s);
Scenario MotionCorrected(Scenario s);
/// A few scans are lost or have wrong stamps; the clock of the last LiDAR is 5 ms ahead.
Scenario Faulty(Scenario s);
/// Worse: the stamps of a busy host, and scans that are lost or come twice.
Scenario Jittery(Scenario s, double stamp_jitter_s);
/// The second LiDAR says nothing for three seconds.
Scenario Silent(Scenario s);

}  // namespace trajlo::simulation
