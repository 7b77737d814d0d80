// SPDX-License-Identifier: MIT
#include "core/report/rig_report.h"

#include <algorithm>
#include <cmath>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

constexpr double kRounding = 1e-9;
/// Three standard deviations of what RigCalibration expects.
constexpr double kFar_m = 0.09;
/// No carrier is larger.
constexpr double kLongestLever_m = 10.0;
constexpr double kFar_rad = 0.06;
constexpr double kFar_s = 0.03;

std::string Distance(const LidarPlace& place) {
  return FormatText("%.3f m, %.2f degrees and %.1f ms", place.moved_m,
                    place.turned_rad * 180.0 / M_PI, 1e3 * place.clock_moved_s);
}

}  // namespace

LidarPlace CorrectedPlace(std::size_t lidar, const SE3& T_body_lidar, double clock_offset_s,
                          const LidarCorrection& correction, RigEvidence evidence) {
  const SE3 found = correction.T_body * T_body_lidar;
  return {lidar,
          found,
          clock_offset_s + correction.clock_s,
          (found.t - T_body_lidar.t).norm(),
          so3::Log(correction.T_body.q).norm(),
          correction.clock_s,
          evidence};
}

std::string CorrectionsText(const std::vector<LidarPlace>& rig) {
  std::string text;
  for (const LidarPlace& place : rig) {
    const bool has_moved = place.moved_m > kRounding || place.turned_rad > kRounding ||
                           std::abs(place.clock_moved_s) > kRounding;
    if (place.evidence != RigEvidence::kConfirmed || !has_moved) continue;
    text += (text.empty() ? "LiDAR " : ", LiDAR ") + std::to_string(place.lidar) + " by " +
            Distance(place);
  }
  return text;
}

std::vector<std::string> RigWarnings(const std::vector<LidarPlace>& rig) {
  std::vector<std::string> warnings;
  // Without a map nothing was looked at; with one, the reference is confirmed.
  const bool has_map = std::any_of(rig.begin(), rig.end(), [](const LidarPlace& place) {
    return place.evidence == RigEvidence::kConfirmed;
  });
  for (const LidarPlace& place : rig) {
    const std::string name = "LiDAR " + std::to_string(place.lidar) + " (counted from 0) ";
    if (const double lever_m = place.T_body_lidar.t.norm(); lever_m > kLongestLever_m) {
      warnings.push_back(name + "sits " + FormatText("%.3g m", lever_m) +
                         " from the origin of the body by sensor.T_body_lidar: translations are in "
                         "metres, and these may be millimetres");
    }
    if (place.evidence == RigEvidence::kContradicted) {
      warnings.push_back(name +
                         "is not where sensor.T_body_lidar says, nor near it: its points "
                         "do not match what the other LiDARs see, and were kept out of the map");
      continue;
    }
    if (place.evidence == RigEvidence::kNone) {
      warnings.push_back(name +
                         "sees nothing that the others saw before: nothing confirms its "
                         "sensor.T_body_lidar");
      continue;
    }
    if (place.evidence == RigEvidence::kNotYet && has_map) {
      warnings.push_back(name +
                         "was not seen together with the others from enough places: nothing "
                         "confirms its sensor.T_body_lidar");
      continue;
    }
    const bool is_near = place.moved_m < kFar_m && place.turned_rad < kFar_rad &&
                         std::abs(place.clock_moved_s) < kFar_s;
    if (is_near) continue;
    warnings.push_back(name + "is " + Distance(place) +
                       " away from what sensor.T_body_lidar and input.clock_offset_s say; what "
                       "was found is in rig.yaml");
  }
  return warnings;
}

}  // namespace trajlo
