// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// Parses poses in KITTI's format: 12 numbers a line, the upper 3x4 of the pose row by row.
/// Rotations are kept as written up to an error of 1e-4 in RᵀR; beyond it they are projected onto
/// SO(3) with one warning, and beyond 0.05 they are no rotations. There are no stamps that could
/// tell which pose is missing, so no line is ever skipped: InputError names the line instead.
/// `path` is used in messages only.
std::vector<Eigen::Affine3d> ParseKittiPoses(const std::filesystem::path& path,
                                             std::string_view text,
                                             std::vector<std::string>* warnings);

}  // namespace trajlo
