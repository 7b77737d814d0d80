// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace trajlo {

/// What a user should know of clouds in this frame; empty if there is nothing to say. By its name,
/// a frame may be fixed to the world (earth, map, odom: ROS's REP 105; world; camera_init: LOAM and
/// its descendants). In such a frame a LiDAR would stand still: the cloud is a result of another
/// odometry, and shows no motion.
std::string DoubtOfFrame(const std::string& frame_id);

}  // namespace trajlo
