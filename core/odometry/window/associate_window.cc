// SPDX-License-Identifier: MIT
#include "core/odometry/window/associate_window.h"

#include <cstddef>
#include <vector>

#include "core/odometry/window/kernel_axes.h"

namespace trajlo {

int AssociateWindow(const MapPyramid& map, const StepSize& tolerance, ThreadPool* threads,
                    Window* window) {
  struct Chunk {
    SegmentAssociation* association;
    std::size_t index;
  };
  std::vector<Chunk> chunks;
  // The newest segment first: most of its cells have not been asked before, which takes longest.
  for (int k = window->size() - 1; k >= 0; --k) {
    Segment& segment = window->At(k);
    const std::size_t count = segment.association.Begin(segment.cloud, window->Pose(k),
                                                        segment.T_world_end, map, tolerance);
    for (std::size_t i = 0; i < count; ++i) chunks.push_back({&segment.association, i});
  }
  // One loop for all segments: that wakes the other threads once.
  threads->ParallelFor(chunks.size(),
                       [&](std::size_t i) { chunks[i].association->Look(chunks[i].index); });
  std::vector<int> searched(window->segments.size());
  threads->ParallelFor(searched.size(), [&](std::size_t k) {
    Segment& segment = window->segments[k];
    searched[k] = segment.association.Finish(&segment.points);
    if (searched[k] == 0) return;
    AssignAxes(window->kernel_axes, &segment.points);
    segment.linearization.reset();
  });
  int total = 0;
  for (const int count : searched) total += count;
  return total;
}

}  // namespace trajlo
