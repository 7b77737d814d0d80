// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/comparison/lockstep_solver.h"
#include "core/comparison/solver_variant.h"
#include "core/config/config.h"

namespace trajlo {

/// What trajlo_compare_solvers was asked for.
struct CompareRequest {
  std::vector<std::string> command_line;
  std::vector<std::string> inputs;
  std::string output;
  /// Empty: no errors against truth.
  std::string truth;
  RunConfig config;
  std::vector<SolverVariant> variants;
  bool lockstep = true;
  bool free = true;
  LockstepOptions lockstep_options;
  bool overwrite = false;
  bool quiet = false;
  /// Draw figures and report at the end.
  bool draw = true;
};

}  // namespace trajlo
