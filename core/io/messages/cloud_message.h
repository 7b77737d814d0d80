// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/point_table.h"

namespace trajlo {

/// The points of one message (or of one sweep of packets), not yet converted.
struct CloudMessage {
  /// Index into CloudMessageReader::topics().
  std::size_t topic = 0;
  /// The stamp in the message's header.
  std::optional<std::int64_t> stamp_ns;
  /// When it was recorded, by the recorder's clock.
  std::int64_t recorded_ns = 0;
  std::string frame_id;
  /// Columns x, y, z and whatever else there is; `table.damage` if points are missing.
  PointTable table;
};

/// The point clouds of a recording that is one file. The rules of RawMessageReader hold here, too.
class CloudMessageReader {
 public:
  virtual ~CloudMessageReader() = default;

  /// All topics of the file; those that are not clouds are listed for information only.
  virtual const std::vector<Topic>& topics() const = 0;
  virtual bool IsCloud(std::size_t topic) const = 0;
  /// From now on only clouds of these topics come; before the first `Next`. Without it, all clouds.
  virtual void Select(const std::vector<std::size_t>& topics) = 0;
  /// The next cloud in the order of recording; false at the end.
  virtual bool Next(CloudMessage* message) = 0;
  virtual const MessageReport& report() const = 0;
};

}  // namespace trajlo
