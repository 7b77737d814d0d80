// SPDX-License-Identifier: MIT
// What must hold between options: each check names both keys, their values and the mend.
#include "core/config/config.h"
#include "core/config/yaml_scalars.h"

namespace trajlo {
namespace {

struct Value {
  const char* key;
  double value;
};

std::string Text(const Value& v) { return std::string(v.key) + " (" + NumberText(v.value) + ")"; }

void RequireLess(const Value& a, const Value& b, const char* why) {
  if (a.value < b.value) return;
  throw ConfigError(Text(a) + " must be less than " + Text(b) + ": " + why);
}

void RequireAtMost(const Value& a, const Value& b, const char* why) {
  if (a.value <= b.value) return;
  throw ConfigError(Text(a) + " must not exceed " + Text(b) + ": " + why);
}

}  // namespace

void CheckConfig(const RunConfig& config) {
  const SegmenterOptions& segmenter = config.odometry.segmenter;
  const MapOptions& map = config.odometry.map.finest;

  RequireLess({"sensor.min_range_m", segmenter.min_range_m},
              {"sensor.max_range_m", segmenter.max_range_m}, "otherwise no point is left");
  RequireAtMost({"expert.segmenter.map_voxel_m", segmenter.map_voxel_m},
                {"expert.segmenter.registration_voxel_m", segmenter.registration_voxel_m},
                "the points to register are taken from those for the map");
  RequireAtMost(
      {"segmenter.interval_s", segmenter.interval_s},
      {"expert.initialization.first_interval_s", config.odometry.initialization.first_interval_s},
      "the first interval is made of whole segments");
  RequireLess({"segmenter.interval_s", segmenter.interval_s},
              {"expert.segmenter.max_gap_s", segmenter.max_gap_s},
              "otherwise the time between two segments would count as a pause");
  RequireLess(
      {"expert.map.min_point_spacing_m", map.min_point_spacing_m},
      {"map.voxel_size_m", map.voxel_size_m},
      "otherwise a voxel holds one point, and no plane is found; 0.4 of the voxel is a good value");
  RequireLess({"map.voxel_size_m", map.voxel_size_m}, {"map.radius_m", map.radius_m},
              "otherwise the map holds nothing");
  const RegistrationOptions& registration = config.odometry.registration;
  if (registration.kernel != KernelKind::kNone && registration.kernel_in_spreads > 0.0) {
    RequireAtMost({"registration.sigma_m", registration.sigma_m},
                  {"3 x expert.registration.kernel_m", kWidestKernel * registration.kernel_m},
                  "the fitted kernel is between the two");
  }
}

}  // namespace trajlo
