// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/io/messages/raw_message.h"

namespace trajlo {

/// The layout of a message by the text of its interface, of ROS 1 (ros1msg) or ROS 2 (ros2msg).
class MessageSchema {
 public:
  /// "sensor_msgs/Imu" and the text with all interfaces that it is made of. Nothing if one of them
  /// is missing, or a line cannot be understood.
  static std::optional<MessageSchema> Parse(std::string_view type, std::string_view text);

  /// The same message in another encoding. Headers lose or get their seq (0). Nothing if the bytes
  /// are cut, or longer than the message.
  std::optional<std::string> Rewrite(std::string_view bytes, Encoding from, Encoding to) const;

 private:
  enum class Kind { kNumber, kString, kTime, kHeader, kNested };
  enum class Array { kNone, kFixed, kSequence };
  struct Field {
    Kind kind = Kind::kNumber;
    /// Of a number.
    std::size_t bytes = 0;
    /// Index into types_.
    std::size_t nested = 0;
    Array array = Array::kNone;
    /// Of a fixed array.
    std::size_t count = 1;
  };
  using Type = std::vector<Field>;
  class Parser;
  class Rewriter;

  /// The first is the message itself.
  std::vector<Type> types_;
};

}  // namespace trajlo
