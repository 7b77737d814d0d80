// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/exit_code.h"

namespace trajlo {

/// What the user typed. The flags are in gflags' FLAGS_ variables by then.
struct CommandLine {
  std::string command;                 ///< "trajlo_run"
  std::vector<std::string> words;      ///< All of it, with the name of the program.
  std::vector<std::string> arguments;  ///< What is neither the program nor a flag.
};

/// What all commands of trajlo have in common lies in RunCommand(); this is what differs.
struct Command {
  const char* name = "";  ///< "trajlo_run"
  const char* help = "";  ///< Examples, flags and exit codes.
  std::function<ExitCode(const CommandLine&)> run;
  /// For completion: what a flag may be; for "" what an argument may be. Empty where any text may
  /// stand, or a file. For --set: "key=", or "key=value" for each value where they are few.
  std::function<std::vector<std::string>(const std::string& flag)> values = {};
  /// The command looks at HandleInterrupts(), which is called before anything else.
  bool ends_gracefully = false;
};

/// The whole main() of a command: answers --help, --version and --completion, reads the flags,
/// runs, and prints what was thrown. Returns the exit code: UsageError and ConfigError are kUsage,
/// InputError is kInputUnreadable, OutputError is kOutputNotWritable, all else is kFailed.
int RunCommand(const Command& command, int argc, char** argv);

/// For commands that take flags only. Throws UsageError.
void RequireNoArguments(const CommandLine& line);

}  // namespace trajlo
