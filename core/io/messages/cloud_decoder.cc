// SPDX-License-Identifier: MIT
#include "core/io/messages/cloud_decoder.h"

#include "core/io/messages/livox_decoder.h"
#include "core/io/messages/point_cloud2_decoder.h"

namespace trajlo {
namespace {

bool IsPointCloud2(std::string_view type) { return type == "sensor_msgs/PointCloud2"; }

bool IsLivox(std::string_view type) {
  return type == "livox_ros_driver/CustomMsg" || type == "livox_ros_driver2/CustomMsg";
}

}  // namespace

bool IsCloudType(std::string_view type) { return IsPointCloud2(type) || IsLivox(type); }

bool DecodeCloud(const Topic& topic, RawMessage* raw, CloudMessage* cloud, std::string* remark) {
  remark->clear();
  cloud->topic = raw->topic;
  cloud->recorded_ns = raw->recorded_ns;
  if (IsPointCloud2(topic.type)) {
    return DecodePointCloud2(topic.encoding, &raw->bytes, cloud, remark);
  }
  if (IsLivox(topic.type)) return DecodeLivox(topic.encoding, &raw->bytes, cloud, remark);
  *remark = "type " + topic.type + " is not a point cloud";
  return false;
}

}  // namespace trajlo
