// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/convert/export_options.h"
#include "apps/exit_code.h"
#include "core/io/conversion/open_bag.h"
#include "core/io/messages/message_writer.h"
#include "core/io/recording/recording_options.h"

namespace trajlo {

struct ConvertRequest {
  /// As --input of trajlo_run.
  std::string input;
  /// A bag, a folder, or a file of poses or of a map: its name tells.
  std::filesystem::path output;
  RecordingOptions recording;
  /// Nothing: messages of bags are copied with all fields, all else becomes Ouster's layout.
  std::optional<CloudLayout> layout;
  /// Of a bag, see OpenBag(); empty: the usual one.
  std::string compression;
  /// The topic whose poses are wanted in place of scans.
  std::string poses;
  /// For results of trajlo_run.
  ExportOptions exports;
  bool overwrite = false;
  bool quiet = false;

  bool WritesBag() const { return poses.empty() && IsBagName(output); }
  IfExists WhatIfExists() const { return overwrite ? IfExists::kReplace : IfExists::kFail; }
};

/// Converts; messages for people go to stdout and stderr. Throws InputError and OutputError.
ExitCode ConvertJob(const ConvertRequest& request, const std::atomic<bool>& stop);

}  // namespace trajlo
