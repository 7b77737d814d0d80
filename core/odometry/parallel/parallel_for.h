// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

namespace trajlo {

/// A bounded number of threads. Work is handed out by index and every index writes its own result,
/// so that no result depends on how many threads there are.
class ThreadPool {
 public:
  /// `threads` = 0 takes all cores; no more than there are would be of use.
  explicit ThreadPool(int threads)
      : arena_(threads > 0 ? std::min(threads, tbb::info::default_concurrency())
                           : tbb::task_arena::automatic) {}

  int threads() { return arena_.max_concurrency(); }

  /// Calls body(i) for every i in [0, count).
  template <typename Body>
  void ParallelFor(std::size_t count, const Body& body) {
    if (count <= 1 || arena_.max_concurrency() == 1) {
      for (std::size_t i = 0; i < count; ++i) body(i);
      return;
    }
    Execute([&] {
      tbb::parallel_for(
          std::size_t{0}, count, [&](std::size_t i) { body(i); }, tbb::simple_partitioner());
    });
  }

  /// Calls body() where these threads, and no others, help with what it runs in parallel.
  template <typename Body>
  void Execute(const Body& body) {
    arena_.execute(body);
  }

 private:
  tbb::task_arena arena_;
};

}  // namespace trajlo
