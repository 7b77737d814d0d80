// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/io/messages/bag_writer.h"
#include "core/io/messages/raw_message.h"
#include "core/io/ros1/ros1_bag_writer.h"

namespace trajlo {

struct MessageCopyOptions {
  /// Empty copies all.
  std::vector<std::string> topics;
  /// Messages recorded in [first + start, first + start + duration), where `first` is when the
  /// first message of the bag was recorded; a duration of 0 copies to the end.
  std::int64_t start_ns = 0;
  std::int64_t duration_ns = 0;
  /// Told the messages read so far and those that are listed.
  std::function<void(std::size_t, std::size_t)> on_progress;
  std::function<bool()> should_stop;
};

struct MessageCopyResult {
  std::size_t messages = 0;
  /// Topics that could not be copied, and why.
  std::map<std::string, std::string> left_out;
  MessageReport report;
};

/// Copies messages of ROS 1 bags that follow each other into one, byte by byte, with their times of
/// recording and with all that is known of their publishers (types' definitions, callerid,
/// latching). A damaged bag gives all that can be read, and the copy has an index again. Throws
/// InputError and OutputError.
MessageCopyResult CopyBags(const std::vector<std::filesystem::path>& bags,
                           const std::filesystem::path& output, const MessageCopyOptions& options,
                           const Ros1BagOptions& bag = {});

/// Copies the messages of a bag of any kind into one of any kind, with their times of recording,
/// all fields, and what is known of their interfaces. Between ROS 1 and ROS 2 they are written anew
/// in the other encoding; a topic whose interface is not known there is left out. Throws InputError
/// and OutputError; the writer is left open.
MessageCopyResult CopyMessages(const std::filesystem::path& path, const MessageCopyOptions& options,
                               BagWriter* writer);

}  // namespace trajlo
