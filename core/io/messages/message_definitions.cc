// SPDX-License-Identifier: MIT
// The interfaces of ROS 1 that we write. Their MD5 sums are the published ones, and a reader of
// bags compares them; they do not depend on the comments, which are left out.
#include "core/io/messages/message_writer.h"

namespace trajlo {
namespace {

#define TRAJLO_HEADER_DEFINITION                                                       \
  "================================================================================\n" \
  "MSG: std_msgs/Header\n"                                                             \
  "uint32 seq\n"                                                                       \
  "time stamp\n"                                                                       \
  "string frame_id\n"

constexpr MessageDescription kPointCloud2{
    "sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181",
    "std_msgs/Header header\n"
    "uint32 height\n"
    "uint32 width\n"
    "sensor_msgs/PointField[] fields\n"
    "bool is_bigendian\n"
    "uint32 point_step\n"
    "uint32 row_step\n"
    "uint8[] data\n"
    "bool is_dense\n" TRAJLO_HEADER_DEFINITION
    "================================================================================\n"
    "MSG: sensor_msgs/PointField\n"
    "uint8 INT8=1\n"
    "uint8 UINT8=2\n"
    "uint8 INT16=3\n"
    "uint8 UINT16=4\n"
    "uint8 INT32=5\n"
    "uint8 UINT32=6\n"
    "uint8 FLOAT32=7\n"
    "uint8 FLOAT64=8\n"
    "string name\n"
    "uint32 offset\n"
    "uint8 datatype\n"
    "uint32 count\n"};

constexpr MessageDescription kLivoxCustomMsg{
    "livox_ros_driver/CustomMsg", "e4d6829bdfe657cb6c21a746c86b21a6",
    "std_msgs/Header header\n"
    "uint64 timebase\n"
    "uint32 point_num\n"
    "uint8 lidar_id\n"
    "uint8[3] rsvd\n"
    "livox_ros_driver/CustomPoint[] points\n" TRAJLO_HEADER_DEFINITION
    "================================================================================\n"
    "MSG: livox_ros_driver/CustomPoint\n"
    "uint32 offset_time\n"
    "float32 x\n"
    "float32 y\n"
    "float32 z\n"
    "uint8 reflectivity\n"
    "uint8 tag\n"
    "uint8 line\n"};

constexpr MessageDescription kPoseStamped{
    "geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5",
    "std_msgs/Header header\n"
    "geometry_msgs/Pose pose\n" TRAJLO_HEADER_DEFINITION
    "================================================================================\n"
    "MSG: geometry_msgs/Pose\n"
    "geometry_msgs/Point position\n"
    "geometry_msgs/Quaternion orientation\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Point\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Quaternion\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n"
    "float64 w\n"};

#undef TRAJLO_HEADER_DEFINITION

}  // namespace

const MessageDescription& DescriptionOf(CloudLayout layout) {
  return layout == CloudLayout::kLivox ? kLivoxCustomMsg : kPointCloud2;
}

const MessageDescription& PoseStampedDescription() { return kPoseStamped; }

}  // namespace trajlo
