// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// How the poses of a file are written.
///   kTum    "stamp x y z qx qy qz qw", seconds, blanks or tabs between the columns; or in
///           all lines "stamp x y z", without rotation
///   kKitti  the upper 3x4 of the pose, row by row, no stamps
///   kEuroc  csv of "stamp, x, y, z, qw, qx, qy, qz", whole nanoseconds, more columns are ignored
enum class TrajectoryFormat { kAuto, kTum, kKitti, kEuroc };

/// "auto", "tum", "kitti", "euroc".
const char* TrajectoryFormatName(TrajectoryFormat format);
std::optional<TrajectoryFormat> ParseTrajectoryFormat(std::string_view name);

/// The poses of a file, in the order of the file.
struct TrajectoryFile {
  TrajectoryFormat format = TrajectoryFormat::kAuto;
  /// One for each pose; empty if the format has no stamps.
  std::vector<std::int64_t> t_ns;
  /// Rotations of a KITTI file are kept as written (orthonormal to about 1e-6 only), because
  /// established tools compute with them so; those of the other formats come from normalised
  /// quaternions.
  std::vector<Eigen::Affine3d> T_world_body;
  /// False: positions alone, and the identity stands for every rotation.
  bool has_rotations = true;
};

/// Reads a trajectory; kAuto tells the format by the first line that is no comment.
/// A byte order mark, CRLF line ends, blanks around the columns, blank lines and lines that begin
/// with # are accepted everywhere. Lines of stamped formats with a number that is not finite or a
/// zero quaternion are skipped and mentioned in `warnings`. Rotations of KITTI files that are off
/// by more than 1e-4 are projected onto SO(3), with a warning.
/// A folder that holds trajectory.tum, a result of trajlo_run, stands for that.
/// Throws InputError, naming the line, for everything that cannot be understood, for a file
/// without poses, and for a bag, which trajlo_convert takes poses out of.
TrajectoryFile ReadTrajectory(const std::filesystem::path& path, TrajectoryFormat format,
                              std::vector<std::string>* warnings);

}  // namespace trajlo
