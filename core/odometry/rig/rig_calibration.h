// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/odometry/segments/segment_cloud.h"
#include "core/odometry/window/window.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Where the LiDARs of a rig really are, found while running.
///
/// Poses that were calibrated, or read from a drawing, are off by a centimetre and some tenths of a
/// degree. Points of two LiDARs then make two walls of one, and the map agrees with both. So the
/// points of LiDAR l are moved by a correction C_l in the body frame, p_body = C_l T_body_lidar
/// p_lidar. One LiDAR is the reference, and its C is 1: the first that sees at least half as much
/// as any other when the recording begins.
///
/// A left perturbation d_l of C_l and a right perturbation xi of the body's pose change a residual
/// alike. So the points of LiDAR l have the normal equations A_l, g_l for either, and the pose is
/// eliminated from the joint ones (Schur complement):
///
///   S_lm = [l = m] A_l - A_l A⁻¹ A_m,   s_l = g_l - A_l A⁻¹ g,   A = sum_l A_l,   g = sum_l g_l.
///
/// That is what the LiDARs tell about each other, whatever the pose is. It is summed over the
/// segments that leave the window, with a memory, on a prior around what was given.
///
/// Map points of a LiDAR would prove any C_l right, and points that see the same planes from the
/// same place share their errors. So those of a LiDAR are registered from the beginning, but enter
/// the map only when it has seen it from enough places. Where it sees nothing that others saw,
/// nothing tells: C_l keeps to its prior.
class RigCalibration {
 public:
  /// Without `is_learning` all C are 1.
  explicit RigCalibration(bool is_learning) : is_learning_(is_learning) {}

  /// A map is to begin of these segments: chooses the reference, if there is none.
  void Begin(std::vector<SegmentCloud>* segments);

  /// Moves the points of a segment to where they are by what is known now. Those that may not enter
  /// the map yet leave its `map_points`, unless no others are in it.
  void Apply(SegmentCloud* cloud) const;

  /// Takes what the oldest segment of a window that is believed tells, at its present poses.
  void Learn(const Window& window);

  /// C_l. 1 for the reference and for a LiDAR that was not seen.
  SE3 Correction(std::size_t lidar) const {
    return lidar < lidars_.size() ? lidars_[lidar].correction : SE3();
  }
  /// Whether the points of a LiDAR enter the map.
  bool IsKnown(std::size_t lidar) const;

 private:
  struct Lidar {
    SE3 correction;
    double places = 0.0;  ///< From so many it has seen.
  };
  void DropUnknown(SegmentCloud* cloud) const;
  void Add(std::size_t lidars);
  void Update();

  bool is_learning_;
  std::optional<std::size_t> reference_;
  std::vector<Lidar> lidars_;
  /// The normal equations of all d_l around the present corrections, without the prior.
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
};

}  // namespace trajlo
