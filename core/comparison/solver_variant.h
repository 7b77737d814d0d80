// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/config/config.h"

namespace trajlo {

/// A way to solve windows, as a name and the options that make it.
struct SolverVariant {
  std::string name;
  /// "key=value,key=value" on top of the common configuration.
  std::string settings;
  OdometryOptions odometry;
  CeresFormOptions ceres_form;
};

/// Reads variants from YAML,
///
///   variants:
///     - {name: gauss_newton, set: "solver.kind=gauss_newton"}
///
/// each on top of `base`. Throws ConfigError naming file and line.
std::vector<SolverVariant> LoadVariants(const std::filesystem::path& path, const RunConfig& base);

/// True if the variant differs from `base` only in what concerns the solution of one window whose
/// points, weights and prior are given: the solver, the kernel, first-estimate Jacobians. Others
/// can only be compared by whole runs.
bool IsAboutOneWindow(const SolverVariant& variant, const RunConfig& base);

}  // namespace trajlo
