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

/// Gains and loses speed as a driver does who is in a hurry; `cruise_s` between start and stop.
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

/// 8 m/s after a take-off, with the tilt that 3 m/s² take.
Scenario FastFlight(const std::string& scene) {
  Scenario s = Flight(scene, 8.0, 60.0);
  s.motion.acceleration_mps2 = 3.0;
  s.motion.max_tilt_deg = 20.0;
  return s;
}

/// A slow take-off, then rising and sinking by turns with hovering.
Scenario Hover(const std::string& scene, double speed_mps) {
  Scenario s = FromRest(Flight(scene, speed_mps, 60.0), 0.4, 6.0, 0.4);
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

/// Worse: stamps of a host that is busy, and scans that are lost or come twice.
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
       [] { return Bursts("hall", MakeLidar("pandar_xt32", SE3(), 1000)); }},
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

      {"hall_long_os1_16", "a minute of flight in the hall; one OS1-16",
       [] { return Flight("hall", 3.0, 60.0); }},
      {"office_long_os0_64", "a minute's walk through the office; OS0-64 with 512 columns",
       [] { return Walk("office", MakeLidar("os0_64", SE3(), 512), 60.0); }},
      {"street_long_hdl64", "a minute in the streets of a city; HDL-64E with 512 columns",
       [] { return Lasting(Drive("street", MakeLidar("hdl64e", SE3(), 512), 10.0), 60.0); }},

      {"motorway_start_hdl64", "from rest to 30 m/s at 3 m/s², and braked to rest; HDL-64E",
       [] { return FromRest(Motorway(MakeLidar("hdl64e", SE3(), 1024), 30.0), 3.0, 5.0, 7.0); }},
      {"motorway_start_os1_128", "the same; OS1-128 with 512 columns",
       [] { return FromRest(Motorway(MakeLidar("os1_128", SE3(), 512), 30.0), 3.0, 5.0, 7.0); }},
      {"motorway_jam_hdl64", "stop and go on the motorway, up to 20 m/s; HDL-64E",
       [] { return FromRest(Motorway(MakeLidar("hdl64e", SE3(), 1024), 20.0), 2.5, 3.0, 6.0); }},
      {"street_start_hdl64", "from rest to 14 m/s at 3 m/s² in a street, and braked hard; HDL-64E",
       [] {
         return FromRest(Drive("street", MakeLidar("hdl64e", SE3(), 1024), 14.0), 3.0, 1.0, 7.0);
       }},
      {"street_stop_and_go_hdl64", "stop and go in the streets among traffic; HDL-64E",
       [] {
         const Scenario s = Drive("street", MakeLidar("hdl64e", SE3(), 1024), 10.0);
         return Lasting(FromRest(Peopled(s), 2.0, 2.0, 3.5), 40.0);
       }},
      {"manhattan_start_hdl32", "from rest to 12 m/s at 3 m/s² between plain buildings; HDL-32E",
       [] {
         const Scenario s = Drive("manhattan", MakeLidar("hdl32e", SE3(), 1085), 12.0);
         return Lasting(FromRest(s, 3.0, 1.0, 7.0), 30.0);
       }},

      {"facade_fast_os1_16", "a minute at 8 m/s to and fro along the facade; one OS1-16",
       [] { return FastFlight("facade"); }},
      {"facade_fast_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(FastFlight("facade"), NtuViralRig()); }},
      {"long_facade_os1_16",
       "a minute at 8 m/s along a row of houses, open to the other side; one OS1-16",
       [] { return FastFlight("long_facade"); }},
      {"long_facade_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(FastFlight("long_facade"), NtuViralRig()); }},

      {"atrium_hover_os1_16", "rising slowly in the atrium, and hovering; one OS1-16",
       [] { return Hover("atrium", 0.6); }},
      {"atrium_hover_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Hover("atrium", 0.6), NtuViralRig()); }},
      {"tall_room_os1_16",
       "rising and hovering in a tall room, plainer than the atrium; one OS1-16",
       [] { return Hover("tall_room", 0.9); }},
      {"tall_room_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Hover("tall_room", 0.9), NtuViralRig()); }},

      {"office_glances_os0_64", "a walk through the office with quick looks about; OS0-64",
       [] { return Glances("office", MakeLidar("os0_64", SE3(), 512)); }},
      {"office_glances_mid360", "the same; Livox MID-360",
       [] { return Glances("office", MakeLidar("mid360")); }},
      {"corridor_glances_vlp16", "a walk along the corridor with quick looks about; VLP-16",
       [] { return Glances("corridor", MakeLidar("vlp16")); }},
      {"corridor_glances_xt32", "the same; PandarXT-32",
       [] { return Glances("corridor", MakeLidar("pandar_xt32", SE3(), 1000)); }},

      {"faults_jitter_os1_16", "the hall, stamps 3 ms off, scans lost and twice; one OS1-16",
       [] { return Jittery(Flight("hall", 3.0, 30.0), 0.003); }},
      {"faults_jitter_os1_16x2", "the courtyard, stamps 5 ms off, scans lost and twice; two OS1-16",
       [] { return Jittery(TwoLidars(Flight("courtyard", 3.0, 30.0), NtuViralRig()), 0.005); }},
      {"faults_office_os0_64", "the office, stamps 2 ms off, scans lost and twice; OS0-64",
       [] { return Jittery(Walk("office", MakeLidar("os0_64", SE3(), 512), 30.0), 0.002); }},

      {"spin_fast_avia", "a platform spun up to 35 rad/s in the hall; Livox Avia",
       [] {
         Scenario s = OnTheSpot("hall", "spin", MakeLidar("avia"));
         s.motion.turn_rate_rad_s = 35.0;
         return s;
       }},
      {"swing_courtyard_avia", "swung on a rope in a courtyard, beyond 3 g; Livox Avia",
       [] { return OnTheSpot("courtyard", "swing", MakeLidar("avia")); }},
      {"bursts_office_os0_64", "violent turns and jolts on a walk through the office; OS0-64",
       [] { return Bursts("office", MakeLidar("os0_64", SE3(), 512)); }},
      {"stairwell_mid360", "up the stairs of four storeys; Livox MID-360",
       [] { return Walk("stairwell", MakeLidar("mid360"), 30.0); }},
      {"forest_vlp16", "a walk through a wood on rolling ground; VLP-16",
       [] { return Walk("forest", MakeLidar("vlp16"), 30.0); }},
      {"corridor_mid360", "a hand-held walk along a corridor with doors; Livox MID-360",
       [] { return Walk("corridor", MakeLidar("mid360"), 15.0); }},
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
