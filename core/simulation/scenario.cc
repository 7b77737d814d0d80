// SPDX-License-Identifier: MIT
// The list of scenarios.
#include "core/simulation/scenario.h"

#include <functional>
#include <stdexcept>

#include "core/options/did_you_mean.h"
#include "core/options/edit_distance.h"
#include "core/simulation/scenario_parts.h"

namespace trajlo::simulation {

namespace {

struct Entry {
  const char* name;
  const char* description;
  std::function<Scenario()> make;
};

SE3 OnItsSide() {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitX())),
          Eigen::Vector3d::Zero()};
}

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

      {"survey_os1_128",
       "taking off in a city and flying 80 m above its streets; OS1-128 that lies on its side",
       [] { return Survey("street", MakeLidar("os1_128", OnItsSide(), 512)); }},

      {"atrium_hover_os1_16", "rising slowly in the atrium, and hovering; one OS1-16",
       [] { return Hover("atrium"); }},
      {"atrium_hover_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Hover("atrium"), NtuViralRig()); }},
      {"tall_room_os1_16",
       "rising and hovering in a tall room, plainer than the atrium; one OS1-16",
       [] { return Hover("tall_room"); }},
      {"tall_room_os1_16x2", "the same with the two OS1-16 of NTU VIRAL",
       [] { return TwoLidars(Hover("tall_room"), NtuViralRig()); }},

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
      {"swing_office_avia", "swung on a rope in a room of the office, beyond 3 g; Livox Avia",
       [] { return OnTheSpot("office", "swing", MakeLidar("avia")); }},
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
  throw std::invalid_argument("there is no scenario '" + name + "'" +
                              Suggestion(NearestOrLonger(name, ScenarioNames())));
}

std::vector<std::string> ScenarioNames() {
  std::vector<std::string> names;
  for (const Entry& entry : Entries()) names.emplace_back(entry.name);
  return names;
}

}  // namespace trajlo::simulation
