// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "core/odometry/health/doubt.h"
#include "core/odometry/odometry_options.h"
#include "core/odometry/start/relocalization.h"
#include "core/odometry/window/step_size.h"

namespace trajlo {

/// From here a window finds its place by itself.
constexpr StepSize kSamePlace = {0.5, 0.12};

/// Looks around, from time to time, for a window of which it is in doubt where it is: what it has
/// seen is looked for in the map, as far as the body may have moved unseen.
class WindowSearch {
 public:
  /// `options` must outlive it.
  explicit WindowSearch(const OdometryOptions& options) : options_(options) {}

  /// Where the window is, if it is time to look and the place is clear. `agreement` is that of the
  /// newest points with the map, MapAgreement::worst; about `turn_axis_world` the body may have
  /// turned most.
  std::optional<SweepMotion> Look(const Window& window, const DoubtWatch& doubt, double agreement,
                                  const Eigen::Vector3d& turn_axis_world, const MapPyramid& map,
                                  ThreadPool* threads);

 private:
  const OdometryOptions& options_;
  /// Waits for a window that begins then.
  std::int64_t next_look_ns_ = std::numeric_limits<std::int64_t>::min();
};

/// Puts a window where its points were found. The next solve begins there.
void MoveWindow(const SweepMotion& found, Window* window);

/// Holds a pose at a place that was found in the map.
MarginalizationPrior AnchorOfFound(const SE3& T_world_found);

}  // namespace trajlo
