// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "core/io/messages/raw_message.h"
#include "core/io/trajectory_reader.h"

namespace trajlo {

/// True for geometry_msgs/PoseStamped, PoseWithCovarianceStamped, TransformStamped and PointStamped
/// and for nav_msgs/Odometry: the messages in which bags carry a ground truth.
bool IsPoseType(std::string_view type);

/// The pose in such a message, of the frame that it names in the frame of its header, m. A point
/// has the identity as its rotation, and so has a pose whose quaternion was left at zero; others
/// are normalised. Nothing if the message is cut or a number is not finite.
std::optional<StampedPose> DecodePose(std::string_view type, Encoding encoding,
                                      std::string_view bytes);

}  // namespace trajlo
