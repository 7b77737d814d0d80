// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/exit_code.h"
#include "core/io/messages/message_writer.h"
#include "core/io/recording/recording_options.h"
#include "core/io/ros1/ros1_bag_writer.h"

namespace trajlo {

struct ConvertRequest {
  /// As --input of trajlo_run.
  std::string input;
  /// A file that ends in .bag, or a folder; with `poses` a file.
  std::filesystem::path output;
  RecordingOptions recording;
  /// Nothing: messages of ROS 1 bags are copied as they are, all else becomes Ouster's layout.
  std::optional<CloudLayout> layout;
  BagCompression compression = BagCompression::kNone;
  /// The topic whose poses are wanted in place of scans.
  std::string poses;
  bool overwrite = false;
  bool quiet = false;

  bool WritesBag() const { return poses.empty() && output.extension() == ".bag"; }
};

/// Converts; messages for people go to stdout and stderr. Throws InputError and OutputError.
ExitCode ConvertJob(const ConvertRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
