// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "core/io/messages/wire_reader.h"

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
  // ROS 2 has signed seconds; no recording is from before 1970 or behind 2106.
  const auto seconds = reader->Read<std::uint32_t>();
  const auto nanoseconds = reader->Read<std::uint32_t>();
  header.stamp_ns = std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
  header.frame_id = reader->ReadString();
  return header;
}

}  // namespace trajlo
