// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "core/io/messages/message_description.h"
#include "core/io/messages/raw_message.h"

namespace trajlo {

/// Writes a bag, whatever its container. The file gets its name by Close(); without Close() nothing
/// remains. Members throw OutputError: no such folder, no permission, disk full, ...
class BagWriter {
 public:
  virtual ~BagWriter() = default;

  /// How messages must be serialised.
  virtual Encoding encoding() const = 0;
  /// The topic is announced with its first message. Times need not increase.
  virtual void Write(const TopicDescription& topic, std::int64_t recorded_ns,
                     std::string_view message) = 0;
  virtual void Close() = 0;
};

}  // namespace trajlo
