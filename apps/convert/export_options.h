// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/export/coloring.h"
#include "core/export/result_bag.h"

namespace trajlo {

/// What of a result of trajlo_run is written, and how.
struct ExportOptions {
  /// Where the recording is now; empty: where it was.
  std::string recording;
  /// Scans and map in a bag; without both, the recording is not needed.
  bool scans = true;
  bool map = true;
  /// Of the map; 0: the least distance of points in the method's map.
  double voxel_m = 0.0;
  ColorBy color = ColorBy::kHeight;
  PointFrame frame = PointFrame::kBody;
  /// The files of a folder of scans: ".pcd" or ".ply".
  std::string scan_files = ".pcd";
  bool keep_lost = false;
};

}  // namespace trajlo
