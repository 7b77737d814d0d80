// SPDX-License-Identifier: MIT
#include "core/report/rig_report.h"

#include <cmath>

#include "core/io/format_text.h"

namespace trajlo {
namespace {

constexpr double kRounding = 1e-9;
/// Three standard deviations of what RigCalibration expects.
constexpr double kFar_m = 0.09;
constexpr double kFar_rad = 0.06;

std::string Distance(const LidarPlace& place) {
  return FormatText("%.3f m and %.2f degrees", place.moved_m, place.turned_rad * 180.0 / M_PI);
}

}  // namespace

LidarPlace ComparePlaces(std::size_t lidar, const SE3& T_body_lidar_given, const SE3& T_body_lidar,
                         bool is_known) {
  return {lidar, T_body_lidar, (T_body_lidar.t - T_body_lidar_given.t).norm(),
          so3::Log(T_body_lidar_given.q.conjugate() * T_body_lidar.q).norm(), is_known};
}

std::string CorrectionsText(const std::vector<LidarPlace>& rig) {
  std::string text;
  for (const LidarPlace& place : rig) {
    const bool has_moved = place.moved_m > kRounding || place.turned_rad > kRounding;
    if (!place.is_known || !has_moved) continue;
    text += (text.empty() ? "LiDAR " : ", LiDAR ") + std::to_string(place.lidar) + " by " +
            Distance(place);
  }
  return text;
}

std::vector<std::string> RigWarnings(const std::vector<LidarPlace>& rig) {
  std::vector<std::string> warnings;
  for (const LidarPlace& place : rig) {
    if (place.moved_m < kFar_m && place.turned_rad < kFar_rad) continue;
    warnings.push_back("LiDAR " + std::to_string(place.lidar) + " seems to be " + Distance(place) +
                       " from where sensor.T_body_lidar says (LiDARs are counted from 0; what was "
                       "found is in rig.yaml)");
  }
  return warnings;
}

}  // namespace trajlo
