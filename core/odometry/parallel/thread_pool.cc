// SPDX-License-Identifier: MIT
#include "core/odometry/parallel/thread_pool.h"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace trajlo {
namespace {

int Concurrency(int threads) {
  const int cores = tbb::info::default_concurrency();
  return threads > 0 ? std::min(threads, cores) : cores;
}

}  // namespace

struct ThreadPool::Arena : tbb::task_arena {
  using tbb::task_arena::task_arena;
};

ThreadPool::ThreadPool(int threads)
    : arena_(std::make_unique<Arena>(Concurrency(threads))), threads_(arena_->max_concurrency()) {}
ThreadPool::~ThreadPool() = default;

void ThreadPool::ParallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (count <= 1 || threads_ == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  arena_->execute(
      [&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner()); });
}

void ThreadPool::Execute(const std::function<void()>& body) { arena_->execute(body); }

}  // namespace trajlo
