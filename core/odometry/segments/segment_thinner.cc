// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segment_thinner.h"

#include <algorithm>
#include <cmath>

#include "core/odometry/segments/choose_evenly.h"

namespace trajlo {
namespace {

constexpr double kFewCells = 200.0;
/// What was seen counts for 1/e after this time.
constexpr double kMemory_s = 2.0;

}  // namespace

void SegmentThinner::Thin(const std::vector<SegmentPoint>& points, SegmentCloud* cloud) {
  map_filter_.Filter(points, &cloud->map_points);
  std::vector<SegmentPoint>* registered = &cloud->registration_points;
  filter_.Filter(cloud->map_points, registered);
  usual_cells_ = std::max(static_cast<double>(registered->size()),
                          usual_cells_ * std::exp(-cloud->Duration_s() / kMemory_s));
  if (usual_cells_ < kFewCells) fine_filter_.Filter(cloud->map_points, registered);
  if (max_points_ > 0) *registered = ChooseEvenly(*registered, max_points_);
}

}  // namespace trajlo
