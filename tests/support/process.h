// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "tests/support/temp_folder.h"

namespace trajlo::testing {

/// A program that runs beside the test, its output going to files.
class Process {
 public:
  /// `max_file_bytes` bounds every file that it writes, as a full disk would; 0 for no bound.
  Process(const std::vector<std::string>& command, rlim_t max_file_bytes = 0) {
    pid_ = fork();
    if (pid_ != 0) return;
    dup2(OpenFile(out_path()), STDOUT_FILENO);
    dup2(OpenFile(err_path()), STDERR_FILENO);
    if (max_file_bytes > 0) {
      const rlimit limit = {max_file_bytes, max_file_bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> argv;
    for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    execv(argv[0], argv.data());
    _exit(127);
  }

  void Signal(int signal) const { kill(pid_, signal); }

  /// True once it has ended.
  bool HasEnded() const {
    siginfo_t info{};
    waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
    return info.si_pid == pid_;
  }

  /// Waits for the end; the exit code, or minus the signal that killed it.
  int Wait() const {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string Out() const { return ReadFile(out_path()); }
  std::string Err() const { return ReadFile(err_path()); }

 private:
  std::filesystem::path out_path() const { return folder_ / "out"; }
  std::filesystem::path err_path() const { return folder_ / "err"; }
  static int OpenFile(const std::filesystem::path& path) {
    return open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }

  TempFolder folder_;
  pid_t pid_ = -1;
};

}  // namespace trajlo::testing
