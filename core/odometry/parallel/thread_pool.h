// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace trajlo {

/// A bounded number of threads. Work is handed out by index and every index writes its own result,
/// so that no result depends on how many threads there are. Built on oneTBB, whose headers only the
/// source includes: each file that does takes a second longer to compile. (A pool of our own whose
/// threads wait actively was no faster.)
class ThreadPool {
 public:
  /// `threads` = 0 takes all cores; more threads than cores are never made.
  explicit ThreadPool(int threads);
  ~ThreadPool();

  int threads() const { return threads_; }

  /// Calls body(i) for every i in [0, count).
  void ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

  /// Calls body() where these threads, and no others, help with what it runs in parallel.
  void Execute(const std::function<void()>& body);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
  int threads_;
};

}  // namespace trajlo
