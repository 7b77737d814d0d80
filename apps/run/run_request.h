// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/report/trajectory_sampler.h"

namespace trajlo {

/// What the command line of trajlo_run asks for.
struct RunRequest {
  std::vector<std::string> inputs;  ///< See OpenRecording().
  std::string output;
  RunConfig config;
  SamplingOptions sampling;
  bool covariance = false;           ///< Write covariance.csv, too.
  bool view = true;                  ///< Write view.ply, too.
  std::set<std::int64_t> inspected;  ///< Windows whose factor graphs are written, too.
  bool overwrite = false;
  bool quiet = false;  ///< Only warnings and errors are printed.
  std::vector<std::string> command_line;
};

}  // namespace trajlo
