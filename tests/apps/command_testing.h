// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/support/process.h"

namespace trajlo::testing {

/// What the call of a command left.
struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Calls a program and waits for its end; see Process.
inline Outcome CallProgram(const char* program, std::vector<std::string> arguments,
                           rlim_t max_file_bytes = 0) {
  arguments.insert(arguments.begin(), program);
  const Process process(arguments, max_file_bytes);
  const int exit_code = process.Wait();
  return {exit_code, process.Out(), process.Err()};
}

}  // namespace trajlo::testing
