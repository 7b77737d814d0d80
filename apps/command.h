// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/exit_code.h"

namespace trajlo {

/// What the user typed. The flags are in gflags' FLAGS_ variables by then.
struct CommandLine {
  std::vector<std::string> words;      ///< All of it, with the name of the program.
  std::vector<std::string> arguments;  ///< What is neither the program nor a flag.
};

/// What all commands of trajlo have in common lies in RunCommand(); this is what differs.
struct Command {
  std::string name;  ///< "trajlo_run"
  std::string help;  ///< Examples, flags and exit codes.
  std::function<ExitCode(const CommandLine&)> run;
};

/// The whole main() of a command: answers --help and --version, reads the flags, runs, and prints
/// what was thrown. Returns the exit code: UsageError and ConfigError are kUsage, InputError is
/// kInputUnreadable, OutputError is kOutputNotWritable.
int RunCommand(const Command& command, int argc, char** argv);

/// For commands that take flags only. Throws UsageError.
void RequireNoArguments(const CommandLine& line);

}  // namespace trajlo
