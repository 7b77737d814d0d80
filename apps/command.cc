// SPDX-License-Identifier: MIT
#include "apps/command.h"

#include <gflags/gflags.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>

#include "apps/usage_error.h"
#include "core/config/config_error.h"
#include "core/io/errors.h"
#include "core/report/versions.h"

namespace trajlo {
namespace {

/// Asked ahead of gflags, whose own help lists the flags of every library that is linked.
bool WantsHelp(const std::vector<std::string>& words) {
  return std::any_of(words.begin(), words.end(), [](const std::string& word) {
    return word == "--help" || word == "-help" || word == "-h";
  });
}

bool WantsVersion() {
  return gflags::GetCommandLineFlagInfoOrDie("version").current_value == "true";
}

void PrintVersion(const std::string& name) {
  const Versions v = GetVersions();
  std::printf("%s %s (commit %s; Eigen %s, Ceres %s, %s)\n", name.c_str(), v.trajlo.c_str(),
              v.git.c_str(), v.eigen.c_str(), v.ceres.c_str(), v.compiler.c_str());
}

/// Ceres reports each failed step as a warning; what is done about it stands in the results.
void QuietenCeres() {
  gflags::SetCommandLineOptionWithMode("minloglevel", "2", gflags::SET_FLAGS_DEFAULT);
  gflags::SetCommandLineOptionWithMode("logtostderr", "true", gflags::SET_FLAGS_DEFAULT);
}

ExitCode Run(const Command& command, const CommandLine& line) {
  const auto fail = [&](ExitCode code, const std::exception& error, const std::string& hint) {
    std::fprintf(stderr, "%s: %s\n%s", command.name.c_str(), error.what(), hint.c_str());
    return code;
  };
  const std::string examples = "(" + command.name + " --help shows examples)\n";
  try {
    return command.run(line);
  } catch (const UsageError& error) {
    return fail(ExitCode::kUsage, error, examples);
  } catch (const ConfigError& error) {
    return fail(ExitCode::kUsage, error, examples);
  } catch (const InputError& error) {
    return fail(ExitCode::kInputUnreadable, error, "");
  } catch (const OutputError& error) {
    return fail(ExitCode::kOutputNotWritable, error, "");
  }
}

}  // namespace

int RunCommand(const Command& command, int argc, char** argv) {
  CommandLine line;
  line.words.assign(argv, argv + argc);
  if (WantsHelp(line.words)) {
    std::fputs(command.help.c_str(), stdout);
    return static_cast<int>(ExitCode::kOk);
  }
  QuietenCeres();
  gflags::ParseCommandLineNonHelpFlags(&argc, &argv, true);
  if (WantsVersion()) {
    PrintVersion(command.name);
    return static_cast<int>(ExitCode::kOk);
  }
  gflags::HandleCommandLineHelpFlags();
  line.arguments.assign(argv + 1, argv + argc);
  // A closed pipe and a limit on file sizes are then errors of the write, like a full disk.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(Run(command, line));
}

void RequireNoArguments(const CommandLine& line) {
  if (line.arguments.empty()) return;
  throw UsageError("unexpected argument '" + line.arguments.front() + "'");
}

}  // namespace trajlo
