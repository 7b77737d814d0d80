// SPDX-License-Identifier: MIT
#include "core/io/rig_yaml.h"

#include "core/io/format_text.h"

namespace trajlo {

std::string RigYaml(const std::string& comment, const std::vector<SE3>& T_body_lidar,
                    const std::vector<double>& clock_offsets_s) {
  std::string yaml = "# " + comment + "\nsensor:\n  T_body_lidar:\n";
  for (const SE3& T : T_body_lidar) {
    yaml += FormatText(
        "    - translation_m: [%.17g, %.17g, %.17g]\n"
        "      rotation: [%.17g, %.17g, %.17g, %.17g]\n",
        T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w());
  }
  std::string offsets;
  for (const double offset_s : clock_offsets_s) {
    offsets += (offsets.empty() ? "" : ", ") + FormatText("%.9f", offset_s);
  }
  if (!offsets.empty()) yaml += "input:\n  clock_offset_s: [" + offsets + "]\n";
  return yaml;
}

}  // namespace trajlo
