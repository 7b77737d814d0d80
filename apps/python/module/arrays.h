// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>

#include <cstdint>
#include <string>
#include <vector>

#include "core/scans/lidar_scan.h"
#include "manifolds/se3.h"

// Between numpy's arrays and ours. What comes in may have any strides, and is copied once. All
// throw DataError, which names the argument, what was found, and what is expected; a masked array
// is refused, as its mask would be lost.
namespace trajlo::python {

namespace py = pybind11;

/// Points (N, 3) of float32 or float64, m, or (N, 4) with intensities; fills xyz_m and, of the
/// latter, intensity of `points`, which gets N elements. True if there were intensities.
bool ReadPoints(const py::object& array, std::vector<LidarPoint>* points);
/// Numbers of any real kind, finite or not; of shape (N,), or a single one.
std::vector<double> ReadReals(const py::object& array, const char* name);
/// Refuses times in s whose type is too coarse for them: at a time of today, float32 is off by up
/// to 64 s. `instead`: what else can be given, such as " or times_ns".
void RequireFineSeconds(const py::object& array, const char* name, const std::string& instead = "");
/// Whole numbers of any kind within int64; of shape (N,), or a single one.
std::vector<std::int64_t> ReadIntegers(const py::object& array, const char* name);
/// Transforms (N, 4, 4): finite, rotations orthonormal to 1e-3.
std::vector<SE3> ReadPoses(const py::object& array, const char* name);
/// The transform (4, 4), which may also be a list of lists.
SE3 ReadPose(const py::object& array, const char* name);

/// A path of any of Python's kinds, in the bytes of the file system.
std::string PathText(const py::object& path);

/// Throws TypeError for arguments that `function` does not have, with the nearest that it has.
void RefuseUnknown(const py::kwargs& unknown, const std::string& function,
                   const std::vector<std::string>& known);

/// True for a single number in place of an array.
bool IsScalar(const py::object& array);

/// (N, 4, 4), with the bottom row 0 0 0 1.
py::array_t<double> PoseArray(const std::vector<SE3>& poses);
/// (4, 4)
py::array_t<double> PoseArray(const SE3& pose);

/// An array of its own with a copy of the numbers.
template <typename T>
py::array_t<T> CopyOf(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

/// A view without a copy of one member of all elements, that keeps `owner` alive.
py::array ReadOnlyView(const py::dtype& dtype, const std::vector<py::ssize_t>& shape,
                       const std::vector<py::ssize_t>& strides, const void* data,
                       const py::object& owner);

}  // namespace trajlo::python
