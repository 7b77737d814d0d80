// SPDX-License-Identifier: MIT
#include "apps/command.h"

#include <gflags/gflags.h>
#include <malloc.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <optional>

#include "apps/completion.h"
#include "apps/failure_text.h"
#include "apps/interrupt.h"
#include "apps/read_flags.h"
#include "apps/usage_error.h"
#include "apps/utf8.h"
#include "core/config/config_error.h"
#include "core/io/errors.h"
#include "core/report/versions.h"

namespace trajlo {
namespace {

/// True if a word of the command line, up to `--`, is one of `wanted`.
bool Has(const std::vector<std::string>& words, std::initializer_list<const char*> wanted) {
  const auto end = std::find(words.begin(), words.end(), "--");
  return std::find_first_of(words.begin(), end, wanted.begin(), wanted.end()) != end;
}

/// The value of --completion=bash or --completion bash; nothing if it is not there.
std::optional<std::string> CompletionShell(const std::vector<std::string>& words) {
  const std::string flag = "--completion";
  if (words.size() < 2 || words[1].compare(0, flag.size(), flag) != 0) return {};
  if (words[1].size() > flag.size()) return words[1].substr(flag.size() + 1);
  return words.size() > 2 ? words[2] : "";
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

/// The C library gives a large array a mapping of its own, which goes back to the system when the
/// array is freed. Unless it is told what is large, it raises the bound with every such array, and
/// what is below the bound leaves holes in the heap: at the end of an hour of pauses and other
/// faults (scripts/soak) a run held an eighth more memory. Scans stay below the bound: to map each
/// of them anew takes time.
void ReturnLargeArrays() {
  constexpr int kLarge = 4 << 20;
  mallopt(M_MMAP_THRESHOLD, kLarge);
}

/// Answers what is about the command itself; false if it is to run.
bool Answer(const Command& command, const std::vector<std::string>& words) {
  if (words.size() == 4 && words[1] == "--complete") {
    for (const std::string& word : Complete(command, words[2], words[3])) std::puts(word.c_str());
  } else if (const auto shell = CompletionShell(words)) {
    std::fputs(CompletionScript(*shell).c_str(), stdout);
  } else if (Has(words, {"--help", "-help", "-h"})) {
    std::fputs(command.help, stdout);
  } else if (Has(words, {"--version", "-version"})) {
    PrintVersion(command.name);
  } else {
    return false;
  }
  return true;
}

ExitCode Run(const Command& command, int argc, char** argv) {
  CommandLine line;
  line.command = command.name;
  line.words.assign(argv, argv + argc);
  if (Answer(command, line.words)) return ExitCode::kOk;
  RequireUtf8(line.words);
  ReturnLargeArrays();
  QuietenCeres();
  line.arguments = ReadFlags(command.name, line.words);
  return command.run(line);
}

/// True if stdout is a pipe whose reader has gone, as head does when it has enough.
bool NobodyReads() {
  pollfd out = {STDOUT_FILENO, POLLOUT, 0};
  return poll(&out, 1, 0) == 1 && (out.revents & POLLERR) != 0;
}

ExitCode Fail(const Command& command, ExitCode code, const char* what) {
  std::fprintf(stderr, "%s: %s\n", command.name, what);
  if (code == ExitCode::kUsage) std::fprintf(stderr, "(%s --help shows examples)\n", command.name);
  return code;
}

/// No exception leaves it.
ExitCode RunGuarded(const Command& command, int argc, char** argv) {
  try {
    const ExitCode code = Run(command, argc, argv);
    const bool is_said = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    if (code != ExitCode::kOk || is_said || NobodyReads()) return code;
    return Fail(command, ExitCode::kOutputNotWritable,
                "the output could not be written completely");
  } catch (const UsageError& error) {
    return Fail(command, ExitCode::kUsage, error.what());
  } catch (const ConfigError& error) {
    return Fail(command, ExitCode::kUsage, error.what());
  } catch (const InputError& error) {
    return Fail(command, ExitCode::kInputUnreadable, error.what());
  } catch (const OutputError& error) {
    return Fail(command, ExitCode::kOutputNotWritable, error.what());
  } catch (const std::exception& error) {
    return Fail(command, ExitCode::kFailed, FailureText(error).c_str());
  }
}

}  // namespace

int RunCommand(const Command& command, int argc, char** argv) {
  if (command.ends_gracefully) HandleInterrupts();
  // A closed pipe and a limit on file sizes are then errors of the write, like a full disk.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  return static_cast<int>(RunGuarded(command, argc, argv));
}

void RequireNoArguments(const CommandLine& line) {
  if (line.arguments.empty()) return;
  throw UsageError("unexpected argument '" + line.arguments.front() + "'");
}

}  // namespace trajlo
