// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "core/odometry/solvers/window_solver.h"
#include "core/odometry/window/window.h"

namespace trajlo {

/// By what a window is weighed in place of what it was. What is empty stays as the run had it.
struct Reweighing {
  /// Window::noise.sigma_m: registration.sigma_m times the root of points_per_error.
  std::optional<double> sigma_m;
  std::optional<KernelKind> kernel;
  /// In all directions. Without it, the widths that were fitted stay, in metres.
  std::optional<double> kernel_m;
  /// Spectral densities of the acceleration: see WhiteNoiseAccelerationTerm.
  std::optional<double> translation_m2_s3, rotation_rad2_s3;
  /// Factor for the information of the marginalisation prior; 0 leaves it out.
  std::optional<double> prior_factor;
  /// RegistrationPoint::weight of all points, in the order of WindowGraph::points; empty: as they
  /// were.
  std::vector<double> point_weights;
};

/// The same window with other weights; its poses stay, and are no solution any more. Throws
/// std::invalid_argument where a number is not finite or out of range, and unless there is a weight
/// for each point.
Window Reweigh(Window window, const Reweighing& reweighing);

struct SolvedWindow {
  Window window;
  SolveSummary summary;
};

/// Solves a window from its poses, with the planes that its points have, until the steps are below
/// 1e-9 m and 1e-10 rad: solutions can be compared.
SolvedWindow SolveToTheEnd(Window window, const WindowSolverFactory& make_solver,
                           SolverOptions options, int max_iterations);

}  // namespace trajlo
