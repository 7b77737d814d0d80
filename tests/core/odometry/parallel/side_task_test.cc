// SPDX-License-Identifier: MIT
#include "core/odometry/parallel/side_task.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace trajlo {
namespace {

class SideTasks : public ::testing::TestWithParam<int> {
 protected:
  ThreadPool threads_{GetParam()};
};

TEST_P(SideTasks, IsDoneAfterWaitBesideALoop) {
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> sum{0};
    int beside = 0;
    SideTask task(&threads_);
    task.Start([&] { beside = 7; });
    threads_.ParallelFor(20, [&](std::size_t i) { sum += static_cast<int>(i); });
    task.Wait();
    EXPECT_EQ(beside, 7);
    EXPECT_EQ(sum, 190);
  }
}

TEST_P(SideTasks, WhatItThrowsReachesTheCaller) {
  SideTask task(&threads_);
  EXPECT_THROW(
      {
        task.Start([] { throw std::runtime_error("beside"); });
        task.Wait();
      },
      std::runtime_error);
}

TEST_P(SideTasks, IsDoneWhenAnExceptionSkipsTheWait) {
  bool is_done = false;
  try {
    SideTask task(&threads_);
    task.Start([&] { is_done = true; });
    throw std::logic_error("the caller's");
  } catch (const std::logic_error&) {
  }
  EXPECT_TRUE(is_done);
}

TEST_P(SideTasks, WithoutWorkThereIsNothingToWaitFor) {
  SideTask task(&threads_);
  EXPECT_NO_THROW(task.Wait());
}

INSTANTIATE_TEST_SUITE_P(Threads, SideTasks, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace trajlo
