// SPDX-License-Identifier: MIT
#include "core/simulation/scenario.h"

#include <functional>
#include <stdexcept>
#include <utility>

namespace trajlo::simulation {

namespace {

/// The LiDARs of NTU VIRAL (brytsknguyen/slict: config/ntuviral.yaml): one horizontal, one vertical
/// that starts its sweep 37 ms later.
SE3 NtuViralHorizontal() { return {Eigen::Quaterniond::Identity(), {-0.050, 0.0, 0.055}}; }

std::vector<LidarConfig> NtuViralRig() {
  Eigen::Matrix3d R;
  R << -1, 0, 0, 0, 0, 1, 0, 1, 0;
  const SE3 vertical(Eigen::Quaterniond(R), {-0.550, 0.030, 0.090});
  std::vector<LidarConfig> rig = {MakeLidar("os1_16", NtuViralHorizontal()),
                                  MakeLidar("os1_16", vertical)};
  rig[1].phase_s = 0.037;
  return rig;
}

/// The LiDARs of Hilti 2021. Their calibration is not public: this mounting is made up.
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

Scenario Silent(Scenario s) {
  s.faults.silent_lidar = 1;
  s.faults.silent_from_s = 5.0;
  s.faults.silent_until_s = 8.0;
  return s;
}

struct Entry {
  const char* name;
  const char* description;
  std::function<Scenario()> make;
};

const std::vector<Entry>& Entries() {
  static const std::vector<Entry> entries = {
      {"hall_os1_16", "a flying robot in a hall, at rest at first; one OS1-16",
       [] { return Flight("hall", 3.0, 15.0); }},
      {"hall_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Flight("hall", 3.0, 15.0), NtuViralRig()); }},
      {"hall_landing_os1_16", "a flight in the hall that ends on the ground; one OS1-16",
       [] { return Landing(Flight("hall", 3.0, 25.0)); }},
      {"moving_start_os1_16", "the recording starts in steady motion through the hall; one OS1-16",
       ConstantTwist},
      {"courtyard_os1_16", "a flying robot takes off in a courtyard; one OS1-16",
       [] { return Flight("courtyard", 3.0, 20.0); }},
      {"square_os1_16", "taking off over an open square; one OS1-16",
       [] { return Flight("square", 4.0, 30.0); }},
      {"square_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Flight("square", 4.0, 30.0), NtuViralRig()); }},
      {"atrium_os1_16", "rising in a tall atrium of plain walls; one OS1-16",
       [] { return Flight("atrium", 1.5, 30.0); }},
      {"facade_os1_16", "a fast flight along a facade, open to the other side; one OS1-16",
       [] { return Flight("facade", 7.0, 25.0); }},
      {"office_os0_64", "a hand-held walk through an office; OS0-64 with 512 columns",
       [] { return Walk("office", MakeLidar("os0_64", SE3(), 512), 15.0); }},
      {"construction_site_hilti", "a walk through a building site; OS0-64 and Livox MID-70",
       [] { return TwoLidars(Walk("construction_site", MakeLidar("os0_64"), 30.0), HiltiRig()); }},
      {"stairwell_xt32", "up the stairs of four storeys; PandarXT-32",
       [] { return Walk("stairwell", MakeLidar("pandar_xt32", SE3(), 1000), 30.0); }},
      {"forest_mid360", "a walk through a wood on rolling ground; Livox MID-360",
       [] { return Walk("forest", MakeLidar("mid360"), 30.0); }},
      {"corridor_vlp16", "a hand-held walk along a corridor with doors; VLP-16",
       [] { return Walk("corridor", MakeLidar("vlp16"), 15.0); }},
      {"car_park_os1_128", "a walk through a car park with people walking about; OS1-128",
       [] { return Peopled(Walk("car_park", MakeLidar("os1_128", SE3(), 512), 30.0)); }},
      {"spin_avia", "a platform spun up to 20 rad/s in a courtyard; Livox Avia",
       [] { return OnTheSpot("courtyard", "spin", MakeLidar("avia")); }},
      {"swing_avia", "swung on a rope in a hall, beyond 3 g; Livox Avia",
       [] { return OnTheSpot("hall", "swing", MakeLidar("avia")); }},
      {"bursts_xt32", "violent turns and jolts on a walk through a hall; PandarXT-32",
       [] {
         Scenario s = Walk("hall", MakeLidar("pandar_xt32", SE3(), 1000), 15.0);
         s.motion.kind = "bursts";
         return s;
       }},
      {"street_hdl64", "a car in the streets of a city, moving from the start; HDL-64E",
       [] { return Drive("street", MakeLidar("hdl64e", SE3(), 1024), 10.0); }},
      {"street_kitti", "the same with traffic and motion-corrected scans, as KITTI has them",
       [] {
         return MotionCorrected(Peopled(Drive("street", MakeLidar("hdl64e", SE3(), 1024), 10.0)));
       }},
      {"motorway_hdl64", "a car on a motorway at 30 m/s among others; HDL-64E",
       [] { return Peopled(Drive("motorway", MakeLidar("hdl64e", SE3(), 1024), 30.0)); }},
      {"manhattan_hdl32", "a car between plain buildings; HDL-32E",
       [] { return Drive("manhattan", MakeLidar("hdl32e", SE3(), 1085), 9.0); }},
      {"faults_os1_16", "the courtyard with lost scans, NaN points and wrong stamps; one OS1-16",
       [] { return Faulty(Flight("courtyard", 3.0, 20.0)); }},
      {"faults_os1_16x2", "the hall with two OS1-16, one silent for three seconds and 5 ms ahead",
       [] { return Silent(Faulty(TwoLidars(Flight("hall", 3.0, 15.0), NtuViralRig()))); }},
  };
  return entries;
}

}  // namespace

Scenario MakeScenario(const std::string& name) {
  for (const Entry& entry : Entries()) {
    if (entry.name != name) continue;
    Scenario scenario = entry.make();
    scenario.name = name;
    scenario.description = entry.description;
    return scenario;
  }
  throw std::invalid_argument("unknown scenario '" + name + "'");
}

std::vector<std::string> ScenarioNames() {
  std::vector<std::string> names;
  for (const Entry& entry : Entries()) names.emplace_back(entry.name);
  return names;
}

}  // namespace trajlo::simulation
