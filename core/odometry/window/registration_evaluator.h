// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/parallel/thread_pool.h"
#include "core/odometry/window/step_size.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// Evaluates the registration of all segments, in parallel over fixed chunks of points whose sums
/// are added in order: the same bits for any number of threads. A segment that is nearer than the
/// tolerance to where it was linearised is not evaluated again, but shifted. When a segment is
/// added, most of the window hardly moves, and only the newest segments are evaluated.
class RegistrationEvaluator {
 public:
  explicit RegistrationEvaluator(ThreadPool* threads, const StepSize& tolerance = {})
      : threads_(threads), tolerance_(tolerance) {}

  /// H, g and cost of every segment at `poses`; without `jacobians` only the cost. Keeps the
  /// linearisations in the window.
  void Evaluate(Window* window, const std::vector<SE3>& poses, bool jacobians,
                std::vector<RegistrationNormalEquations>* equations);

 private:
  /// Whether the linearisation of segment k holds at `poses`.
  bool IsKnown(const Window& window, const std::vector<SE3>& poses, std::size_t k) const;

  struct Chunk {
    std::size_t segment, first, count;
    SegmentLinearizer::Sum sum;
  };
  ThreadPool* threads_;
  StepSize tolerance_;
  std::vector<Chunk> chunks_;
};

/// Puts the registration of all segments, which were linearised near by, around the window's poses.
void ShiftRegistration(Window* window);

}  // namespace trajlo
