// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/io/messages/raw_message.h"
#include "core/io/ros1/ros1_bag_writer.h"

namespace trajlo {

struct BagCopyOptions {
  /// Empty copies all.
  std::vector<std::string> topics;
  /// Messages recorded in [first + start, first + start + duration), where `first` is when the
  /// first message of the bag was recorded; a duration of 0 copies to the end.
  std::int64_t start_ns = 0;
  std::int64_t duration_ns = 0;
  Ros1BagOptions output;
  /// Told the messages read so far and those that are listed.
  std::function<void(std::size_t, std::size_t)> on_progress;
  std::function<bool()> should_stop;
};

struct BagCopyResult {
  std::size_t messages = 0;
  MessageReport report;
};

/// Copies messages of ROS 1 bags that follow each other into one, byte by byte, with their times of
/// recording and with all that is known of their publishers (types' definitions, callerid,
/// latching). A damaged bag gives all that can be read, and the copy has an index again. Throws
/// InputError and OutputError.
BagCopyResult CopyBags(const std::vector<std::filesystem::path>& bags,
                       const std::filesystem::path& output, const BagCopyOptions& options);

}  // namespace trajlo
