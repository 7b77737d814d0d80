// SPDX-License-Identifier: MIT
#pragma once

#include "core/odometry/weights/registration_options.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// How the points of a window hold it where they hold it least: a rigid motion of all its control
/// poses, in the frame of the newest one.
struct WindowCondition {
  /// Information (1/m²) about that motion that is certain; 0 where all of it may be spurious. The
  /// points alone give a standard deviation of 1 / sqrt(smallest_eigenvalue) metres.
  double smallest_eigenvalue = 0.0;
  /// [rho; theta], body frame, unit length. Rotations are in metres: at the lever arm at which the
  /// points hold rotations as well as translations.
  Vector6d weak_direction = Vector6d::Zero();
};

/// Information that no chance explains: of the eigenvectors u of H - (1 + 3 sqrt(2 / N_F)) F, the
/// one for which
///
///   (1 - 6 / N) (uᵀ (H - (1 + 3 sqrt(2 / N_F)) F) u - 3 s(u))
///
/// is least. Three things are taken off, each with three standard deviations:
///   - F, the spurious part of the registration's information H (which is without
///     points whose plane may be no surface): SpuriousInformation.
///   - What hangs on few places. H is a sum over places where planes were fitted, and some of them
///     are false. If the places had been others, the sum would have been another. s(u) is the
///     standard deviation of that, from the differences between 16 groups of places: it is the sum
///     divided by sqrt(n) if n places tell equally much. A plane that each of two thousand points
///     confirms is safe; five points, each on a plane of its own, prove nothing.
///   - Of N errors that are independent, six are spent on finding the pose: with fewer, points
///     agree whatever the pose is. `points_per_error` points share one.
///
/// And where the points scatter farther about their planes than sigma_m, they tell less than they
/// were taken to: sigma_m² / scatter² of it.
WindowCondition ConditionOf(const Window& window, const RegistrationOptions& registration);

}  // namespace trajlo
