// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo::simulation {

/// A way through a scene that is free of obstacles for about half a metre on either side (more for
/// vehicles): corners in the world frame, metres.
struct Route {
  std::vector<Eigen::Vector3d> points;
  /// Whether the last point leads back to the first. An open route is walked to and fro.
  bool closed = true;
};

/// A route with rounded corners, by arc length.
class RoutePath {
 public:
  /// Corners are rounded over about `rounding_m`.
  RoutePath(const Route& route, double rounding_m);

  /// Any arc length: a closed route goes round, an open one to and fro.
  Eigen::Vector3d PositionAt(double arc_length_m) const;
  /// The direction of travel about the vertical, without jumps: an open route turns by pi over the
  /// metres about its end.
  double HeadingAt(double arc_length_m) const;
  /// How far it is from there to where an open route turns; infinite for a closed one.
  double DistanceToTurn(double arc_length_m) const;
  double length_m() const { return length_m_; }

 private:
  struct Place {
    std::size_t sample;
    double fraction;
    int lap;
    bool backwards;
  };
  Place Locate(double arc_length_m) const;

  bool closed_;
  double length_m_ = 0.0;
  double winding_rad_ = 0.0;  // What the heading gains in one lap.
  std::vector<Eigen::Vector3d> samples_;
  std::vector<double> headings_;
};

}  // namespace trajlo::simulation
