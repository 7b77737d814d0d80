// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/io/messages/message_description.h"
#include "core/io/messages/message_header.h"
#include "core/io/messages/wire_writer.h"
#include "core/scans/lidar_scan.h"
#include "manifolds/se3.h"

namespace trajlo {

/// As which driver writes them.
enum class CloudLayout {
  /// sensor_msgs/PointCloud2 of 48 bytes a point: x y z intensity (float32), t (uint32, ns),
  /// reflectivity ring ambient (uint16), range (uint32, mm).
  kOuster,
  /// sensor_msgs/PointCloud2 of 22 bytes a point: x y z intensity (float32), ring (uint16),
  /// time (float32, s).
  kVelodyne,
  /// livox_ros_driver/CustomMsg: intensity becomes reflectivity, rounded and clamped to 0..255.
  kLivox
};

/// std_msgs/Header, with which stamped messages begin. Throws OutputError for a stamp that it
/// cannot hold: before 1970 or behind 2106 in ROS 1, before 1901 or behind 2038 in ROS 2. So do all
/// that write messages with one.
void PutHeader(const MessageHeader& header, WireWriter* out);
/// geometry_msgs/Pose and geometry_msgs/Transform alike: x y z, then the quaternion x y z w.
void PutPose(const SE3& pose, WireWriter* out);

const MessageDescription& DescriptionOf(CloudLayout layout);

/// Serialises a scan. Point times count from `sweep_start_ns`; the header's
/// stamp may be another time, as with drivers that stamp the end of the sweep. Positions and
/// (except for Livox) intensities keep all bits, also those of NaN; the scan does not know rings
/// and ambient light, which become 0. Throws std::invalid_argument if an Ouster's or Livox's time
/// does not fit: before the sweep's start or more than 4.29 s behind it.
std::string WriteCloud(CloudLayout layout, const MessageHeader& header, std::int64_t sweep_start_ns,
                       const LidarScan& scan, Encoding encoding = Encoding::kRos1);

/// sensor_msgs/PointCloud2 whose fields are all float32: `values` are those of the first point,
/// then those of the second, ...
std::string WriteFloatCloud(const MessageHeader& header, const std::vector<std::string>& fields,
                            const std::vector<float>& values, Encoding encoding);

/// geometry_msgs/PoseStamped.
std::string WritePoseStamped(const MessageHeader& header, const SE3& T_world_body,
                             Encoding encoding = Encoding::kRos1);

}  // namespace trajlo
