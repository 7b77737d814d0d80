// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "core/odometry/map/neighbors.h"
#include "core/options/describe.h"

namespace trajlo {

/// When the neighbours of a place make a plane. With the standard deviations l1 <= l2 of the
/// neighbours along their principal axes within the plane, and the thickness
///
///   l0² = 1/n sum (e_i / (1 - h_i))²,   h_i = 1/n (1 + v_i² / l1² + u_i² / l2²),
///
/// where e_i, v_i and u_i are the coordinates of point i along the normal and these two axes, from
/// the mean: e_i / (1 - h_i) is how far the point lies from the plane through the others.
///
/// What a plane must show is not that it fits its points, but that they predict one another. A
/// scan line on a road and one point of a post beside it lie on a vertical plane, within
/// millimetres. On a motorway two of a hundred points had such planes, and two thirds of all
/// information along the road: they hold a car that starts to move where it is, since the scan line
/// moves with it.
/// Source: D. Allen, The relationship between variable selection and data augmentation and a method
/// for prediction, Technometrics 1974 (predicted residuals).
struct PlaneFitOptions {
  int neighbors = 8;
  static constexpr int kMinNeighbors = 5;
  double min_width_in_spacings = 0.53;
  /// Upper bound of l0 / l1.
  static constexpr double kMaxFlatness = 0.8;
  /// Lower bound of l1 in standard deviations of the noise of the points. The map's points around
  /// a place that noise displaces fill a ball, of which the nearest make planes in any
  /// direction: they pass through wherever one asks, and hold the sensor there.
  static constexpr double kMinWidthInScatters = 1.5;
  double min_incidence_sine = 0.1;
  double max_wide_flatness = 0.1;
  /// Upper bound of the distance between a preferred plane of a coarser level and the point that
  /// asks for it, in l1: farther off stands something else, of which the coarser levels have no
  /// points (a post in front of a wall).
  static constexpr double kMaxWideDistanceInWidths = 0.3;
  /// A plane that is this much thicker than noise makes it weighs half as much as a thin one.
  static constexpr double kHalfWeightThickness_m = 0.05;
  /// Noise makes planes this thick, in its standard deviations: what it adds to predicted
  /// residuals, and chance. It is the same for all planes, and tells nothing against one of them.
  /// Where the lasers of a scanner are off, each by its own error, a plane that several of them see
  /// is thicker than one that a single one draws, and tells more.
  static constexpr double kThicknessOfNoise = 2.0;

  template <typename Describer>
  void Describe(Describer& d) {
    d(OptionFor::kExperts, "neighbors", neighbors, Range<int>{kMinNeighbors, kMaxNeighbors},
      "Map points taken for a plane (paper: 5).");
    d(OptionFor::kExperts, "min_width_in_spacings", min_width_in_spacings, Range<double>{0.0, 10.0},
      "Lower bound of the neighbours' standard deviation along a plane's shorter axis, in spacings "
      "of the map's points: neighbours on one scan line have no normal.");
    // Neighbours on one scan line that is ragged (a facade with recesses, leaves) span the cone of
    // that beam: a plane through the sensor, which would hold the sensor where it was.
    d(OptionFor::kExperts, "min_incidence_sine", min_incidence_sine, Range<double>{0.0, 0.9},
      "Planes that meet the ray to the point at a smaller angle than this sine's are taken only "
      "where there is no other: a plane through the sensor is mostly a scan line, no surface.");
    d(OptionFor::kExperts, "max_wide_flatness", max_wide_flatness, Range<double>{0.0, 1.0},
      "A plane of a coarser level that is thin, and flatter than this, is preferred to those of "
      "the finer ones; 0 never prefers one.");
  }
};

/// The plane nᵀ (x - center) = offset about a center in the world frame that is kept elsewhere.
struct PlaneNumbers {
  Eigen::Vector3f normal_world = Eigen::Vector3f::Zero();
  float offset_m = 0.0F;
  float thickness_m = 0.0F;  ///< l0
  float width_m = 0.0F;      ///< l1; zero says that there is no plane.
  /// How far the noise of n neighbours tilts the normal, about the longer axis:
  /// sum e_i² / (n (n - 3) l1²).
  float normal_variance_rad2 = 0.0F;
};

/// The same, and from which side it is seen.
struct FittedPlane : PlaneNumbers {
  /// No neighbour was seen from behind: the normal points to where they were seen from.
  bool is_one_sided = false;

  bool exists() const { return width_m > 0.0F; }
  /// Whether a ray from a sensor meets the plane from a side from which it was never seen: what it
  /// hits is the other side of a door, or of a bridge.
  bool IsBehind(const Eigen::Vector3f& ray_world) const {
    return is_one_sided && normal_world.dot(ray_world) > 0.0F;
  }
};

/// The plane through the neighbours of `center_world` by principal component analysis; one that
/// does not exist where they make none. `spacing_m` is the least distance between points of a
/// voxel.
FittedPlane FitPlane(const Neighbors& neighbors, const Eigen::Vector3d& center_world,
                     const PlaneFitOptions& options, double spacing_m);

}  // namespace trajlo
