// SPDX-License-Identifier: MIT
#pragma once

#include <tbb/task_group.h>

#include <utility>

#include "core/odometry/parallel/parallel_for.h"

namespace trajlo {

/// Work that another thread of the pool may do while this one does its own. In a pool of one thread
/// it is done when it starts.
class SideTask {
 public:
  /// `threads` must outlive it.
  explicit SideTask(ThreadPool* threads) : threads_(threads) {}
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;
  /// Waits. What the work threw is lost unless Wait() was called, which an exception may have
  /// skipped.
  ~SideTask() {
    try {
      Wait();
    } catch (...) {
    }
  }

  /// What `work` refers to must live as long as this object.
  template <typename Work>
  void Start(Work work) {
    if (threads_->threads() == 1) {
      work();
    } else {
      threads_->Execute([&] { group_.run(std::move(work)); });
    }
  }
  /// Until the work is done, if there is any; throws what it threw. Does it itself if no other
  /// thread has begun.
  void Wait() {
    if (threads_->threads() > 1) threads_->Execute([&] { group_.wait(); });
  }

 private:
  ThreadPool* threads_;
  tbb::task_group group_;
};

}  // namespace trajlo
