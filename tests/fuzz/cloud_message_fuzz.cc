// SPDX-License-Identifier: MIT
// Serialised point clouds: the first byte tells message and encoding.
#include "core/io/messages/cloud_decoder.h"
#include "tests/fuzz/clouds.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace trajlo;
  if (size == 0) return 0;
  constexpr const char* kTypes[] = {"sensor_msgs/PointCloud2", "livox_ros_driver/CustomMsg",
                                    "livox_ros_driver2/CustomMsg"};
  Topic topic;
  topic.name = "/cloud";
  topic.type = kTypes[(data[0] >> 1U) % std::size(kTypes)];
  topic.encoding = (data[0] & 1U) == 0 ? Encoding::kRos1 : Encoding::kCdr;
  RawMessage raw;
  raw.bytes = fuzz::AsFileBytes(fuzz::AsText(data + 1, size - 1));
  CloudMessage cloud;
  std::string remark;
  if (DecodeCloud(topic, &raw, &cloud, &remark)) {
    fuzz::Require(cloud.table.count <= size, "a message has no more points than bytes");
    fuzz::RequireSound(cloud.table, cloud.stamp_ns);
  } else {
    fuzz::Require(!remark.empty(), "what is refused has a reason");
    fuzz::Require(raw.bytes.size() == size - 1, "what is refused is as it was");
  }
  return 0;
}
