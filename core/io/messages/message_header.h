// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "core/io/messages/wire_reader.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {

/// std_msgs/Header, with which every stamped message begins.
struct MessageHeader {
  /// ROS 1 only.
  std::uint32_t seq = 0;
  std::int64_t stamp_ns = 0;
  std::string frame_id;
};

inline MessageHeader ReadMessageHeader(WireReader* reader) {
  MessageHeader header;
  if (!reader->is_cdr()) header.seq = reader->Read<std::uint32_t>();
  // ROS 2 has signed seconds.
  const std::int64_t seconds = reader->is_cdr() ? std::int64_t{reader->Read<std::int32_t>()}
                                                : std::int64_t{reader->Read<std::uint32_t>()};
  const auto nanoseconds = reader->Read<std::uint32_t>();
  header.stamp_ns = seconds * kNsPerSecond + nanoseconds;
  header.frame_id = reader->ReadString();
  return header;
}

}  // namespace trajlo
