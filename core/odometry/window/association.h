// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/odometry/map/map_pyramid.h"
#include "core/odometry/parallel/parallel_for.h"
#include "core/odometry/sensing/segment_cloud.h"
#include "factors/registration_point.h"
#include "manifolds/se3.h"

namespace trajlo {

struct AssociationOptions {
  PlaneFitOptions plane;
  /// The nearest neighbour may be this many thresholds away.
  double reach_in_thresholds = 2.0;
  /// A point keeps its plane until it has moved by more than this since the plane was looked up,
  /// times the ratio of the plane's level: where points are sparse, the plane of the next few would
  /// be another one, and windows would not converge. A point without a plane has asked all levels,
  /// and keeps that answer as long as a plane of the coarsest.
  double reassociate_distance_m = 0.02;
};

/// The planes of one segment's points, kept from round to round.
class SegmentAssociation {
 public:
  /// Associates every point at its own time on T_begin..T_end. `renew` also looks up again the
  /// points that found no plane before (the map may have grown since).
  /// `associated` receives those with a plane, in the order of `points`; it is left as it is where
  /// no point was looked up anew. Returns the number of look-ups.
  int Associate(const std::vector<SegmentPoint>& points, const SE3& T_begin, const SE3& T_end,
                const MapPyramid& map, const AssociationOptions& options, double threshold_m,
                bool renew, ThreadPool* threads, std::vector<RegistrationPoint>* associated);

 private:
  struct Entry {
    Eigen::Vector3d looked_up_at;
    double keep_m = 0.0;
    Plane plane;
    enum class State : unsigned char { kNew, kNone, kPlane } state = State::kNew;
  };
  std::vector<Entry> entries_;
  std::vector<int> chunk_searched_;
};

}  // namespace trajlo
