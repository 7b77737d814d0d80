// SPDX-License-Identifier: MIT
#include "core/odometry/parallel/side_task.h"

#include <tbb/task_group.h>

namespace trajlo {

struct SideTask::Group : tbb::task_group {};

SideTask::SideTask(ThreadPool* threads) : threads_(threads), group_(std::make_unique<Group>()) {}

SideTask::~SideTask() {
  try {
    Wait();
  } catch (...) {
  }
}

void SideTask::Start(const std::function<void()>& work) {
  if (threads_->threads() == 1) {
    work();
  } else {
    threads_->Execute([&] { group_->run(work); });
  }
}

void SideTask::Wait() {
  if (threads_->threads() > 1) threads_->Execute([&] { group_->wait(); });
}

}  // namespace trajlo
