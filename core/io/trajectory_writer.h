// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/io/output_file.h"
#include "manifolds/se3.h"

namespace trajlo {

/// Writes a trajectory in TUM's format while it grows: "stamp tx ty tz qx qy qz qw", stamp in
/// seconds, exactly as the int64 nanoseconds say, everything with nine decimals.
/// Each line is one write(2) of its own, so a killed process leaves whole lines. The bytes depend
/// on the poses only, not on the locale. Members throw OutputError.
class TumWriter {
 public:
  explicit TumWriter(const std::filesystem::path& path, IfExists if_exists = IfExists::kFail);

  void Append(std::int64_t t_ns, const SE3& T_world_body);
  /// Waits until everything appended is on the disk.
  void Flush() { file_.Sync(); }
  void Close() { file_.Close(); }

 private:
  OutputFile file_;
};

/// Writes poses in KITTI's format: the first three rows of T_world_body, row by row, 12 numbers
/// a line, no stamps. The same guarantees as TumWriter.
class KittiWriter {
 public:
  explicit KittiWriter(const std::filesystem::path& path, IfExists if_exists = IfExists::kFail);

  void Append(const SE3& T_world_body);
  void Flush() { file_.Sync(); }
  void Close() { file_.Close(); }

 private:
  OutputFile file_;
};

}  // namespace trajlo
