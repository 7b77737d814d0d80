// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/file_bytes.h"
#include "core/io/messages/message_description.h"

namespace trajlo {

/// How the bytes of a message are laid out.
enum class Encoding { kRos1, kCdr };

/// One topic of a bag.
struct Topic {
  std::string name;
  /// Without ROS 2's "/msg": "sensor_msgs/PointCloud2".
  std::string type;
  Encoding encoding = Encoding::kRos1;
  /// As many as the file lists, or as a scan of a damaged file found.
  std::uint64_t messages = 0;
  /// What else is known of it, to be printed: of sensors' packets how their times are understood.
  std::string remark{};
  /// What the bag says of the messages' interface, of ROS 2's qualities of service, and whether who
  /// comes late gets the last message all the same: for copies.
  MessageDescription interface {};
  std::string qos{};
  bool is_latched = false;
};

/// A message as the bag holds it.
struct RawMessage {
  /// Index into RawMessageReader::topics().
  std::size_t topic = 0;
  /// When it was recorded, by the recorder's clock.
  std::int64_t recorded_ns = 0;
  FileBytes bytes;
};

/// What could not be read so far.
struct MessageReport {
  /// True if the file is cut or broken: what was read is a part only.
  bool damaged = false;
  std::uint64_t bytes_lost = 0;
  /// A sentence each, with file and offset.
  std::vector<std::string> warnings;
};

/// The messages of one bag, whatever its container. Opening throws InputError when the file is no
/// such bag or nothing of it can be read; after that no damage throws: reading ends or goes on
/// behind it, and `report()` says so. Memory holds one chunk of the file at most.
class RawMessageReader {
 public:
  virtual ~RawMessageReader() = default;

  virtual const std::vector<Topic>& topics() const = 0;
  /// From now on only messages of these topics come; before the first `Next`. Without it, all.
  virtual void Select(const std::vector<std::size_t>& topics) = 0;
  /// The next message in the order of recording; false at the end. Reuses the memory of `message`
  /// where it can.
  virtual bool Next(RawMessage* message) = 0;
  virtual const MessageReport& report() const = 0;
};

}  // namespace trajlo
