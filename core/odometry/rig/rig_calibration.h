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

/// What the map says about where a LiDAR is. From kNone on, its points enter the map.
enum class RigEvidence {
  kContradicted,  ///< Its points lie beside the map.
  kNotYet,        ///< It has not seen the map from enough places.
  kNone,          ///< It sees nothing that the others saw.
  kConfirmed,     ///< Also of the reference, and where nothing is to be learnt.
};

/// Online calibration: the extrinsics and the time offsets of the LiDARs of a rig, found while
/// running.
///
/// Poses that were calibrated, or read from a drawing, are off by a centimetre and a few tenths of
/// a degree, and clocks by a few milliseconds. Points of two LiDARs then make two walls of one, and
/// the map agrees with both. So the points of LiDAR l are moved by a correction in the body frame,
/// p_body = C_l T_body_lidar p_lidar, and in time, t + c_l. One LiDAR is the reference, which has
/// none: the first that sees at least half as much as any other when the recording begins.
///
/// A left perturbation d_l of C_l and a right perturbation xi of the body's pose change a residual
/// alike, and a change of c_l as xi = v c_l, where v is the body's twist. So the points of LiDAR l
/// have the normal equations A_l, g_l for xi, and BᵀA_l B, Bᵀg_l for its unknowns, B = [I v]. The
/// pose is eliminated from the joint ones (Schur complement):
///
///   S_lm = Bᵀ([l = m] A_l - A_l A⁻¹ A_m) B,   s_l = Bᵀ(g_l - A_l A⁻¹ g),
///
/// where A and g are the sums over all LiDARs. S and s are what the LiDARs say about each other,
/// whatever the pose is. They are summed over the segments that leave the window, with a memory, on
/// a prior around what was given.
///
/// Map points of a LiDAR would prove any correction right, and points that see the same planes from
/// the same place share their errors. So those of a LiDAR are registered from the beginning, but
/// enter the map only when it has seen it from enough places, and they lie on it nearly as those of
/// the reference do. If they do not, it is somewhere else by more than registration can find.
/// Where it sees nothing that others saw, there is no evidence, and it stays where it was said to
/// be.
class RigCalibration {
 public:
  /// Without `is_learning` nothing is corrected.
  explicit RigCalibration(bool is_learning) : is_learning_(is_learning) {}

  /// A map is about to begin with these segments: chooses the reference, if there is none.
  void Begin(std::vector<SegmentCloud>* segments);

  /// Moves the points of a segment to where they are by what is known now; in time they were moved
  /// when the segment was cut, by Clocks_s(). Those that may not enter the map yet leave its
  /// `map_points`, unless no others are in it.
  void Apply(SegmentCloud* cloud) const;

  /// Learns what the oldest segment of a window that is believed tells, at its present poses.
  void Learn(const Window& window);

  /// Nothing for the reference and for a LiDAR that was not seen.
  LidarCorrection Correction(std::size_t lidar) const {
    return lidar < lidars_.size() ? lidars_[lidar].correction : LidarCorrection();
  }
  /// Those of the clocks, for Segmenter::CorrectClocks.
  std::vector<double> Clocks_s() const;
  /// Whether the points of a LiDAR enter the map.
  bool IsKnown(std::size_t lidar) const { return EvidenceFor(lidar) >= RigEvidence::kNone; }
  RigEvidence EvidenceFor(std::size_t lidar) const;

 private:
  struct Lidar {
    LidarCorrection correction;
    double places = 0.0;  ///< From how many it has seen the map.
    /// Its points of late: all, those that have a plane, and those that lie on it.
    double points = 0.0, with_plane = 0.0, on_plane = 0.0;
    /// What the map said before it had points of this LiDAR.
    RigEvidence evidence = RigEvidence::kNotYet;
  };
  void DropUnknown(SegmentCloud* cloud) const;
  void Add(std::size_t lidars);
  void NotePlaces(const Window& window);
  void NoteAgreement(const Window& window);
  RigEvidence Judge(const Lidar& lidar) const;
  Eigen::VectorXd LearntSince(const SegmentCloud& cloud) const;
  void Update();

  bool is_learning_;
  std::optional<std::size_t> reference_;
  std::vector<Lidar> lidars_;
  /// The normal equations of all [d_l; c_l] around the present corrections, without the prior.
  Eigen::MatrixXd H_;
  Eigen::VectorXd g_;
};

}  // namespace trajlo
