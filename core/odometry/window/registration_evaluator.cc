// SPDX-License-Identifier: MIT
#include "core/odometry/window/registration_evaluator.h"

#include <algorithm>

namespace trajlo {

bool RegistrationEvaluator::IsKnown(const Window& window, const std::vector<SE3>& poses,
                                    std::size_t k) const {
  const auto& known = window.segments[k].linearization;
  return known &&
         AreNear(known->T_world_begin, known->T_world_end, poses[k], poses[k + 1], tolerance_);
}

void RegistrationEvaluator::Evaluate(Window* window, const std::vector<SE3>& poses, bool jacobians,
                                     std::vector<RegistrationNormalEquations>* equations) {
  constexpr std::size_t kChunk = 256;
  const std::size_t segments = window->segments.size();
  std::vector<SegmentLinearizer> linearizers;
  linearizers.reserve(segments);
  chunks_.clear();
  for (std::size_t k = 0; k < segments; ++k) {
    linearizers.emplace_back(poses[k], poses[k + 1], window->NoiseOf(window->segments[k]));
    if (IsKnown(*window, poses, k)) continue;
    const std::size_t count = window->segments[k].points.size();
    for (std::size_t first = 0; first < count; first += kChunk) {
      chunks_.push_back({k, first, std::min(kChunk, count - first), {}});
    }
  }
  threads_->ParallelFor(chunks_.size(), [&](std::size_t i) {
    Chunk& chunk = chunks_[i];
    const RegistrationPoint* points = window->segments[chunk.segment].points.data() + chunk.first;
    if (jacobians) {
      chunk.sum = linearizers[chunk.segment].Linearize(points, chunk.count);
    } else {
      chunk.sum.cost = linearizers[chunk.segment].Cost(points, chunk.count);
    }
  });
  std::vector<SegmentLinearizer::Sum> sums(segments);
  for (const Chunk& chunk : chunks_) sums[chunk.segment].Add(chunk.sum);
  equations->assign(segments, {});
  for (std::size_t k = 0; k < segments; ++k) {
    RegistrationNormalEquations& result = (*equations)[k];
    std::optional<LinearizedRegistration>& known = window->segments[k].linearization;
    if (IsKnown(*window, poses, k)) {
      result = known->At(poses[k], poses[k + 1]);
    } else if (jacobians) {
      result = linearizers[k].Finish(sums[k]);
      known = {poses[k], poses[k + 1], result};
    } else {
      result.cost = sums[k].cost;
    }
  }
}

void ShiftRegistration(Window* window) {
  for (int k = 0; k < window->size(); ++k) {
    Segment& segment = window->At(k);
    segment.registration = segment.linearization->At(window->Pose(k), window->Pose(k + 1));
  }
}

}  // namespace trajlo
