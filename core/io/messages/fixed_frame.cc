// SPDX-License-Identifier: MIT
#include "core/io/messages/fixed_frame.h"

#include <algorithm>
#include <array>

namespace trajlo {

std::string DoubtOfFrame(const std::string& frame_id) {
  constexpr std::array<const char*, 5> kFixed = {"earth", "map", "odom", "world", "camera_init"};
  // A robot's own frames may have its name before them: /robot1/odom.
  const std::string name = frame_id.substr(frame_id.rfind('/') + 1);
  if (std::find(kFixed.begin(), kFixed.end(), name) == kFixed.end()) return "";
  return "the points are in frame '" + frame_id +
         "', which by its name does not move with the LiDAR: a cloud that was registered already "
         "shows no motion. Choose the topic of the LiDAR itself (input.topics), unless only the "
         "name is wrong";
}

}  // namespace trajlo
