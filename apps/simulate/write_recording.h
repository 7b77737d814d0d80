// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>

#include "core/simulation/recording_writer.h"
#include "core/simulation/simulator.h"

namespace trajlo {

struct RecordingRequest {
  std::filesystem::path output;
  bool overwrite = false;
  std::optional<simulation::BagFormat> bag;  ///< Else a folder of scans.
  int threads = 0;                           ///< 0 for all processors.
};

/// Simulates a recording, writes it, and prints how much it is. False if a signal ended it early:
/// what is written goes until then. Throws std::runtime_error where nothing can be written, or
/// where the output holds something that must not be replaced.
bool WriteRecording(const simulation::Simulator& simulator, const RecordingRequest& request,
                    const std::atomic<bool>& stop);

}  // namespace trajlo
