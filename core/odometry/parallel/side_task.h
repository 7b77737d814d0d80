// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "core/odometry/parallel/thread_pool.h"

namespace trajlo {

/// Work that another thread of the pool may do while this one does its own. In a pool of one thread
/// it is done when it starts.
class SideTask {
 public:
  /// `threads` must outlive it.
  explicit SideTask(ThreadPool* threads);
  SideTask(const SideTask&) = delete;
  SideTask& operator=(const SideTask&) = delete;
  /// Waits. What the work threw is lost unless Wait() was called, which an exception may have
  /// skipped.
  ~SideTask();

  /// What `work` refers to must live as long as this object.
  void Start(const std::function<void()>& work);
  /// Until the work is done, if there is any; throws what it threw. Does it itself if no other
  /// thread has begun.
  void Wait();

 private:
  struct Group;
  ThreadPool* threads_;
  std::unique_ptr<Group> group_;
};

}  // namespace trajlo
