// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/io/inspection/inspection.h"

namespace trajlo {

/// How to run on a recording.
struct RunAdvice {
  /// The whole command for a shell; empty if the recording has no clouds.
  std::string command;
  /// The name of the configuration that is closest, as `--config` takes it; empty if none is.
  std::string config;
  /// What the command does not know, a sentence each.
  std::vector<std::string> remarks;
};

RunAdvice AdviseRun(const RecordingInspection& recording);

}  // namespace trajlo
