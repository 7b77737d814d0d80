// SPDX-License-Identifier: MIT
#include "core/simulation/scenario_parts.h"

#include <utility>

namespace trajlo::simulation {

namespace {

SE3 NtuViralHorizontal() { return {Eigen::Quaterniond::Identity(), {-0.050, 0.0, 0.055}}; }

}  // namespace

std::vector<LidarConfig> NtuViralRig() {
  Eigen::Matrix3d R;
  R << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  const SE3 vertical(Eigen::Quaterniond(R), {-0.550, 0.030, 0.090});
  std::vector<LidarConfig> rig = {MakeLidar("os1_16", NtuViralHorizontal()),
                                  MakeLidar("os1_16", vertical)};
  rig[1].phase_s = 0.037;
  return rig;
}

std::vector<LidarConfig> HiltiRig() {
  std::vector<LidarConfig> rig = {
      MakeLidar("os0_64", SE3(), 512),
      MakeLidar("mid70", {Eigen::Quaterniond::Identity(), {0.06, 0.0, -0.09}})};
  rig[1].phase_s = 0.051;
  return rig;
}

Scenario Flight(const std::string& scene, double speed_mps, double duration_s) {
  Scenario s;
  s.scene = scene;
  s.rig = {MakeLidar("os1_16", NtuViralHorizontal())};
  s.motion.kind = "flight";
  s.motion.speed_mps = speed_mps;
  s.duration_s = duration_s;
  return s;
}

Scenario Walk(const std::string& scene, const LidarConfig& lidar, double duration_s) {
  Scenario s;
  s.scene = scene;
  s.rig = {lidar};
  s.duration_s = duration_s;
  return s;
}

Scenario Drive(const std::string& scene, const LidarConfig& lidar, double speed_mps) {
  Scenario s;
  s.scene = scene;
  s.rig = {lidar};
  s.motion.kind = "drive";
  s.motion.moving_start = true;
  s.motion.speed_mps = speed_mps;
  s.motion.height_m = 1.73;
  return s;
}

Scenario FromRest(Scenario s, double acceleration_mps2, double cruise_s, double braking_mps2) {
  s.motion.moving_start = false;
  s.motion.unevenness = 0.0;
  s.motion.acceleration_mps2 = acceleration_mps2;
  s.motion.cruise_s = cruise_s;
  s.motion.braking_mps2 = braking_mps2;
  return s;
}

Scenario Motorway(const LidarConfig& lidar, double speed_mps) {
  Scenario s = Drive("motorway", lidar, speed_mps);
  s.moving_objects = true;
  s.duration_s = 30.0;
  return s;
}

Scenario FastFlight(const std::string& scene) {
  Scenario s = Flight(scene, 8.0, 60.0);
  s.motion.acceleration_mps2 = 3.0;
  s.motion.max_tilt_deg = 20.0;
  return s;
}

Scenario Survey(const std::string& scene, const LidarConfig& lidar) {
  Scenario s = Flight(scene, 4.0, 40.0);
  s.rig = {lidar};
  s.motion.raised_m = 80.0;
  s.motion.climb_s = 20.0;
  return s;
}

Scenario Hover(const std::string& scene) {
  Scenario s = FromRest(Flight(scene, 0.6, 60.0), 0.4, 8.0, 0.4);
  s.motion.climb_s = 12.0;
  s.motion.stop_s = 4.0;
  return s;
}

Scenario Glances(const std::string& scene, const LidarConfig& lidar) {
  Scenario s = Walk(scene, lidar, 30.0);
  s.motion.kind = "glances";
  s.motion.burst_deg = 90.0;
  return s;
}

Scenario Bursts(const std::string& scene, const LidarConfig& lidar) {
  Scenario s = Walk(scene, lidar, 15.0);
  s.motion.kind = "bursts";
  return s;
}

Scenario Lasting(Scenario s, double duration_s) {
  s.duration_s = duration_s;
  return s;
}

Scenario OnTheSpot(const std::string& scene, const std::string& motion, const LidarConfig& lidar) {
  Scenario s;
  s.scene = scene;
  s.rig = {lidar};
  s.motion.kind = motion;
  s.motion.rest_s = 1.0;
  s.duration_s = 8.0;
  return s;
}

Scenario TwoLidars(Scenario s, std::vector<LidarConfig> rig) {
  s.rig = std::move(rig);
  return s;
}

Scenario Peopled(Scenario s) {
  s.moving_objects = true;
  return s;
}

Scenario Landing(Scenario s) {
  s.motion.landing = true;
  return s;
}

Scenario ConstantTwist() {
  Scenario s = Flight("hall", 1.5, 15.0);
  s.motion.kind = "twist";
  s.motion.moving_start = true;
  s.motion.turn_rate_rad_s = 0.5;
  return s;
}

Scenario MotionCorrected(Scenario s) {
  s.motion_corrected = true;
  return s;
}

Scenario Faulty(Scenario s) {
  s.faults.dropped_scan_fraction = 0.03;
  s.faults.nan_point_fraction = 0.01;
  s.faults.duplicate_stamp_fraction = 0.02;
  s.faults.backward_stamp_fraction = 0.01;
  s.faults.stamp_jitter_s = 0.0002;
  s.rig.back().clock_offset_s = 0.005;
  return s;
}

Scenario Jittery(Scenario s, double stamp_jitter_s) {
  s.faults.dropped_scan_fraction = 0.05;
  s.faults.repeated_scan_fraction = 0.03;
  s.faults.nan_point_fraction = 0.02;
  s.faults.duplicate_stamp_fraction = 0.02;
  s.faults.stamp_jitter_s = stamp_jitter_s;
  return s;
}

Scenario Silent(Scenario s) {
  s.faults.silent_lidar = 1;
  s.faults.silent_from_s = 5.0;
  s.faults.silent_until_s = 8.0;
  return s;
}

}  // namespace trajlo::simulation
