// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/ros2/mcap_index.h"
#include "core/io/ros2/mcap_stream.h"

namespace trajlo {

/// The messages of an MCAP file (https://mcap.dev/spec), chunks compressed with zstd, with lz4 or
/// not at all, ROS 2's messages or ROS 1's; also of a file that its recorder did not finish.
/// They come in the order of the file, which is the order in which they were recorded: log times
/// may step back by the little that publishers overlap. McapStream says what damage costs.
class McapReader final : public RawMessageReader {
 public:
  /// `shown` is the name for messages to the user, if it is not `path`.
  explicit McapReader(const std::filesystem::path& path, const std::filesystem::path& shown = {});

  const std::vector<Topic>& topics() const override { return index_.topics.topics(); }
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(RawMessage* message) override;
  const MessageReport& report() const override { return report_; }

 private:
  void Finish();

  std::filesystem::path shown_;
  McapIndex index_;
  std::unique_ptr<McapStream> stream_;
  /// For each topic: whether it is wanted, and how many of its messages were met.
  std::vector<bool> selected_;
  std::vector<std::uint64_t> met_;
  std::uint64_t not_unpacked_ = 0;
  bool finished_ = false;
  MessageReport report_;
  /// Where a scan has told all damage, reading the messages finds it again.
  MessageReport again_;
};

}  // namespace trajlo
