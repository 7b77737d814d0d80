// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/trajectory_reader.h"

namespace trajlo {

struct ExtractedPoses {
  /// In the order of time, each stamp once.
  std::vector<StampedPose> poses;
  /// Messages that hold no pose: cut, not finite, or, where others have a rotation or a stamp, a
  /// zero quaternion or stamp.
  std::size_t unreadable = 0;
  /// Poses that are left out since another one has their stamp.
  std::size_t contradicted = 0;
  MessageReport report;
};

/// The poses that a bag (ROS 1 or 2, or a folder of bags that follow each other) has on a topic of
/// PoseStamped, PoseWithCovarianceStamped, TransformStamped, PointStamped or Odometry. Throws
/// InputError: no such topic (the message lists those there are), or no pose. Where no stamp is
/// filled, the times of recording stand for them; where no pose has a rotation, the identity does.
/// Whatever is odd about stamps and rotations goes into the report's warnings.
ExtractedPoses ExtractPoses(const std::filesystem::path& recording, const std::string& topic);

}  // namespace trajlo
