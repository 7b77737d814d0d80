// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <string>

#include "core/io/messages/cloud_decoder.h"
#include "core/io/messages/message_writer.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {

inline FileBytes ToFileBytes(const std::string& text) {
  FileBytes bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

inline const char* TypeOf(CloudLayout layout) { return DescriptionOf(layout).type.c_str(); }

/// Decodes a message in ROS 1's encoding.
inline bool Decode(const std::string& type, const std::string& bytes, CloudMessage* cloud,
                   std::string* remark) {
  RawMessage raw;
  raw.bytes = ToFileBytes(bytes);
  return DecodeCloud({"/cloud", type, Encoding::kRos1, 0}, &raw, cloud, remark);
}

inline CloudMessage Decoded(const std::string& type, const std::string& bytes) {
  CloudMessage cloud;
  std::string remark;
  EXPECT_TRUE(Decode(type, bytes, &cloud, &remark)) << remark;
  EXPECT_EQ(remark, "");
  return cloud;
}

/// A scan of n points that begins at `start_ns` and lasts 0.1 s.
inline LidarScan MakeScan(std::size_t n, std::int64_t start_ns) {
  LidarScan scan;
  scan.stamp_ns = start_ns;
  for (std::size_t i = 0; i < n; ++i) {
    const auto f = static_cast<float>(i);
    LidarPoint point;
    point.xyz_m = {0.37F * f - 4.1F, 10.3F / (1.0F + f), -0.011F * f};
    point.intensity = static_cast<float>(i % 256);
    point.t_ns = start_ns + static_cast<std::int64_t>(i * 99'999'999 / n);
    scan.points.push_back(point);
  }
  return scan;
}

}  // namespace trajlo
