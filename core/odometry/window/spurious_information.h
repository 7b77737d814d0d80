// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "factors/registration_point.h"
#include "factors/segment_linearizer.h"

namespace trajlo {

/// The information that points seem to give because the normals of their planes are noisy.
///
/// A wall along x tells nothing about x: every normal is perpendicular to it. But the normals come
/// from a few map points each. One that is tilted by e has the component e along x, and the point
/// seems to hold x with information w e². On average over the noise, that is
///
///   F = sum_i w_i G_i Cov(n_i) G_iᵀ,   G_i = [I; [x_i]x],   Cov(n_i) = v_i (I - n_i n_iᵀ),
///
/// with w_i the weight of the point in H (kernel included), x_i its place, j_i = G_i n_i its
/// Jacobian and v_i the variance of its normal. H - F is what the true planes would have given. It
/// is computed when a segment is the newest, and kept.
struct SpuriousInformation {
  /// F for a rigid perturbation [rho; theta] of the body frame at the start of the segment.
  Matrix6d mean = Matrix6d::Zero();
  /// Sums of w_i v_i and of (w_i v_i)²: how many normals are independent, see ConditionOf.
  double sum = 0.0;
  double sum_of_squares = 0.0;

  /// What the points with an infinite v_i tell, sum w_i j_i j_iᵀ: all of it may be spurious. One
  /// scan line round a corner makes a perfect plane, which is no surface.
  Matrix6d no_surface = Matrix6d::Zero();
  /// What the others tell, dealt into groups by where they lie: points of one place, which share
  /// planes, are always in the same group. See ConditionOf.
  static constexpr int kGroups = 16;
  std::array<Matrix6d, kGroups> by_place;

  SpuriousInformation() { by_place.fill(Matrix6d::Zero()); }
};

/// Of the points of one segment.
SpuriousInformation SpuriousInformationOf(const std::vector<RegistrationPoint>& points,
                                          const SE3& T_begin, const SE3& T_end,
                                          const RegistrationNoise& noise);

}  // namespace trajlo
