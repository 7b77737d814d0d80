// SPDX-License-Identifier: MIT
#include "core/report/draw_script.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace trajlo {

namespace {

std::filesystem::path ScriptsFolder() {
  if (const char* set = std::getenv("TRAJLO_SCRIPTS")) return set;
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  return program.parent_path().parent_path() / "share/trajlo/scripts";
}

/// By the exit codes that the scripts share.
DrawOutcome Judge(const std::filesystem::path& script, int status) {
  constexpr int kAnyFailure = 1, kNotWritable = 5;  // 1: also of Python, if a module is missing
  if (!WIFEXITED(status)) {
    return {script.string() + " was ended by signal " + std::to_string(WTERMSIG(status))};
  }
  const int code = WEXITSTATUS(status);
  if (code == 0) return {};
  if (code == kNotWritable) return {"they cannot be written; what failed is said above", true};
  const std::string failed = script.string() + " failed; what it said is above";
  if (code != kAnyFailure) return {failed};
  return {failed + ". It needs python3-numpy, python3-matplotlib and python3-jinja2"};
}

}  // namespace

DrawOutcome RunDrawScript(const std::string& name, const std::filesystem::path& folder) {
  const std::filesystem::path script = ScriptsFolder() / name;
  std::error_code error;
  if (!std::filesystem::exists(script, error)) return {script.string() + " is not there"};

  std::string words[] = {script.string(), folder.string()};
  char* argv[] = {words[0].data(), words[1].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // The standard output is for the table.
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int problem = posix_spawn(&child, words[0].c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (problem != 0) return {script.string() + " cannot be started: " + std::strerror(problem)};
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return {std::string("waiting for the script failed: ") + std::strerror(errno)};
    }
  }
  return Judge(script, status);
}

}  // namespace trajlo
