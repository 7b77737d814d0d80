// SPDX-License-Identifier: MIT
#include "core/odometry/window/registration_evaluator.h"

#include <algorithm>

namespace trajlo {

void RegistrationEvaluator::Evaluate(const Window& window, const std::vector<SE3>& poses,
                                     bool jacobians,
                                     std::vector<RegistrationNormalEquations>* equations) {
  constexpr std::size_t kChunk = 256;
  std::vector<SegmentLinearizer> linearizers;
  linearizers.reserve(window.segments.size());
  chunks_.clear();
  for (std::size_t k = 0; k < window.segments.size(); ++k) {
    linearizers.emplace_back(poses[k], poses[k + 1], window.noise);
    const std::size_t count = window.segments[k].points.size();
    for (std::size_t first = 0; first < count; first += kChunk) {
      chunks_.push_back({k, first, std::min(kChunk, count - first), {}});
    }
  }
  threads_->ParallelFor(chunks_.size(), [&](std::size_t i) {
    Chunk& chunk = chunks_[i];
    const RegistrationPoint* points = window.segments[chunk.segment].points.data() + chunk.first;
    const SegmentLinearizer& linearizer = linearizers[chunk.segment];
    if (jacobians) {
      chunk.sum = linearizer.Linearize(points, chunk.count);
    } else {
      chunk.sum.cost = linearizer.Cost(points, chunk.count);
    }
  });
  std::vector<SegmentLinearizer::Sum> sums(window.segments.size());
  for (const Chunk& chunk : chunks_) sums[chunk.segment].Add(chunk.sum);
  equations->assign(window.segments.size(), {});
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (jacobians) {
      (*equations)[k] = linearizers[k].Finish(sums[k]);
    } else {
      (*equations)[k].cost = sums[k].cost;
    }
  }
}

void ShiftRegistration(const Eigen::VectorXd& xi,
                       std::vector<RegistrationNormalEquations>* equations) {
  for (std::size_t k = 0; k < equations->size(); ++k) {
    RegistrationNormalEquations& segment = (*equations)[k];
    const Vector12d step = xi.segment<12>(6 * static_cast<Eigen::Index>(k));
    const Vector12d H_step = segment.H * step;
    segment.cost += segment.g.dot(step) + 0.5 * step.dot(H_step);
    segment.g += H_step;
  }
}

}  // namespace trajlo
