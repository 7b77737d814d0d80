// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>

#include "core/scans/lidar_scan.h"

namespace trajlo::python {

/// What a user says about a scan; None where nothing is said.
struct ScanArrays {
  /// (N, 3), m, LiDAR frame, or (N, 4) with intensities; NaN for a return that is missing.
  pybind11::object points;
  pybind11::object times_s;      ///< (N,), after the stamp; or
  pybind11::object times_ns;     ///< (N,), absolute; neither: the scan is motion-corrected.
  pybind11::object intensities;  ///< (N,)
  pybind11::object stamp_ns;     ///< A whole number.
  std::int64_t lidar;
};

/// Copies the arrays once. Throws DataError.
LidarScan MakeScan(const ScanArrays& arrays);

}  // namespace trajlo::python
