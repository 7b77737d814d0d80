// SPDX-License-Identifier: MIT
// The interfaces of ROS 1 that we write, without their comments.
#include <algorithm>

#include "core/io/messages/message_description.h"

namespace trajlo {
namespace {

constexpr char kRule[] =
    "================================================================================\n";

constexpr char kHeader[] =
    "MSG: std_msgs/Header\n"
    "uint32 seq\n"
    "time stamp\n"
    "string frame_id\n";

constexpr char kPointField[] =
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
    "uint32 count\n";

constexpr char kLivoxPoint[] =
    "MSG: livox_ros_driver/CustomPoint\n"
    "uint32 offset_time\n"
    "float32 x\n"
    "float32 y\n"
    "float32 z\n"
    "uint8 reflectivity\n"
    "uint8 tag\n"
    "uint8 line\n";

constexpr char kPoint[] =
    "MSG: geometry_msgs/Point\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n";

constexpr char kVector3[] =
    "MSG: geometry_msgs/Vector3\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n";

constexpr char kQuaternion[] =
    "MSG: geometry_msgs/Quaternion\n"
    "float64 x\n"
    "float64 y\n"
    "float64 z\n"
    "float64 w\n";

constexpr char kPoseStamped[] =
    "MSG: geometry_msgs/PoseStamped\n"
    "std_msgs/Header header\n"
    "geometry_msgs/Pose pose\n";
constexpr char kPose[] =
    "MSG: geometry_msgs/Pose\n"
    "geometry_msgs/Point position\n"
    "geometry_msgs/Quaternion orientation\n";

/// The interface and those that it is made of.
std::string Join(std::string text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) text += std::string(kRule) + part;
  return text;
}

/// Replaces every line of `text` by what `replace` makes of it.
template <typename Replace>
std::string ReplaceLines(std::string_view text, Replace&& replace) {
  std::string all;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    all += replace(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return all;
}

bool BeginsWith(std::string_view line, std::string_view word) {
  return line.substr(0, word.size()) == word;
}

}  // namespace

std::string Ros2TypeName(std::string_view type) {
  std::string name(type);
  const std::size_t slash = name.find('/');
  if (slash != std::string::npos && name.find("/msg/") == std::string::npos) {
    name.insert(slash, "/msg");
  }
  // Livox's driver has another name in ROS 2, and the same messages.
  if (BeginsWith(name, "livox_ros_driver/")) name.insert(16, "2");
  return name;
}

std::string Ros2Definition(std::string_view ros1_definition) {
  bool in_header = false, has_time = false, has_duration = false;
  std::string text = ReplaceLines(ros1_definition, [&](std::string_view line) -> std::string {
    if (BeginsWith(line, "MSG:")) in_header = line.find("std_msgs/Header") != line.npos;
    if (in_header && BeginsWith(line, "uint32 seq")) return "";
    const bool is_time = BeginsWith(line, "time ") || BeginsWith(line, "time[");
    const bool is_duration = BeginsWith(line, "duration ") || BeginsWith(line, "duration[");
    has_time |= is_time;
    has_duration |= is_duration;
    std::string own(line);
    if (is_time) own.replace(0, 4, "builtin_interfaces/Time");
    if (is_duration) own.replace(0, 8, "builtin_interfaces/Duration");
    if (BeginsWith(own, "Header ")) own.insert(0, "std_msgs/");
    const std::size_t livox = own.find("livox_ros_driver/");
    if (livox != std::string::npos) own.insert(livox + 16, "2");
    return own + "\n";
  });
  const std::string rest = "int32 sec\nuint32 nanosec\n";
  if (has_time) text += kRule + std::string("MSG: builtin_interfaces/Time\n") + rest;
  if (has_duration) text += kRule + std::string("MSG: builtin_interfaces/Duration\n") + rest;
  return text;
}

const MessageDescription& PointCloud2Description() {
  static const MessageDescription description{"sensor_msgs/PointCloud2",
                                              "1158d486dd51d683ce2f1be655c3c181",
                                              Join("std_msgs/Header header\n"
                                                   "uint32 height\n"
                                                   "uint32 width\n"
                                                   "sensor_msgs/PointField[] fields\n"
                                                   "bool is_bigendian\n"
                                                   "uint32 point_step\n"
                                                   "uint32 row_step\n"
                                                   "uint8[] data\n"
                                                   "bool is_dense\n",
                                                   {kHeader, kPointField})};
  return description;
}

const MessageDescription& LivoxCustomMsgDescription() {
  static const MessageDescription description{"livox_ros_driver/CustomMsg",
                                              "e4d6829bdfe657cb6c21a746c86b21a6",
                                              Join("std_msgs/Header header\n"
                                                   "uint64 timebase\n"
                                                   "uint32 point_num\n"
                                                   "uint8 lidar_id\n"
                                                   "uint8[3] rsvd\n"
                                                   "livox_ros_driver/CustomPoint[] points\n",
                                                   {kHeader, kLivoxPoint})};
  return description;
}

const MessageDescription& PoseStampedDescription() {
  static const MessageDescription description{"geometry_msgs/PoseStamped",
                                              "d3812c3cbc69362b77dc0b19b345f8f5",
                                              Join("std_msgs/Header header\n"
                                                   "geometry_msgs/Pose pose\n",
                                                   {kHeader, kPose, kPoint, kQuaternion})};
  return description;
}

const MessageDescription& OdometryDescription() {
  static const MessageDescription description{"nav_msgs/Odometry",
                                              "cd5e73d190d741a2f92e81eda573aca7",
                                              Join("std_msgs/Header header\n"
                                                   "string child_frame_id\n"
                                                   "geometry_msgs/PoseWithCovariance pose\n"
                                                   "geometry_msgs/TwistWithCovariance twist\n",
                                                   {kHeader,
                                                    "MSG: geometry_msgs/PoseWithCovariance\n"
                                                    "geometry_msgs/Pose pose\n"
                                                    "float64[36] covariance\n",
                                                    kPose, kPoint, kQuaternion,
                                                    "MSG: geometry_msgs/TwistWithCovariance\n"
                                                    "geometry_msgs/Twist twist\n"
                                                    "float64[36] covariance\n",
                                                    "MSG: geometry_msgs/Twist\n"
                                                    "geometry_msgs/Vector3 linear\n"
                                                    "geometry_msgs/Vector3 angular\n",
                                                    kVector3})};
  return description;
}

const MessageDescription& PathDescription() {
  static const MessageDescription description{
      "nav_msgs/Path", "6227e2b7e9cce15051f669a5e197bbf7",
      Join("std_msgs/Header header\n"
           "geometry_msgs/PoseStamped[] poses\n",
           {kHeader, kPoseStamped, kPose, kPoint, kQuaternion})};
  return description;
}

const MessageDescription& TfMessageDescription() {
  static const MessageDescription description{
      "tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec",
      Join("geometry_msgs/TransformStamped[] transforms\n", {"MSG: geometry_msgs/TransformStamped\n"
                                                             "std_msgs/Header header\n"
                                                             "string child_frame_id\n"
                                                             "geometry_msgs/Transform transform\n",
                                                             kHeader,
                                                             "MSG: geometry_msgs/Transform\n"
                                                             "geometry_msgs/Vector3 translation\n"
                                                             "geometry_msgs/Quaternion rotation\n",
                                                             kVector3, kQuaternion})};
  return description;
}

const MessageDescription* FindDescription(std::string_view type) {
  for (const MessageDescription* known :
       {&PointCloud2Description(), &LivoxCustomMsgDescription(), &PoseStampedDescription(),
        &OdometryDescription(), &PathDescription(), &TfMessageDescription()}) {
    if (Ros2TypeName(known->type) == Ros2TypeName(type)) return known;
  }
  return nullptr;
}

}  // namespace trajlo
