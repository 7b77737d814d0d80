// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "core/odometry/health/window_statistics.h"

namespace trajlo::python {

/// The columns of windows.csv as arrays (N,) of int64, float64 or text. Beside begin_s and end_s,
/// which are rounded, there are begin_ns and end_ns.
pybind11::dict WindowTable(const std::vector<WindowStatistics>& windows);
/// The same of one window, as numbers.
pybind11::dict WindowRow(const WindowStatistics& window);

}  // namespace trajlo::python
