// SPDX-License-Identifier: MIT
#include "apps/python/module/arrays.h"

#include <cmath>
#include <cstring>

#include "apps/python/module/errors.h"
#include "core/io/format_text.h"
#include "core/options/did_you_mean.h"

namespace trajlo::python {
namespace {

std::string ShapeText(const py::array& array) { return py::str(array.attr("shape")); }

[[noreturn]] void Fail(const std::string& name, const std::string& expected,
                       const std::string& found) {
  throw DataError(name + ": must be " + expected + ", found " + found);
}

/// What a mask hides would be used as if it were not hidden.
void RequireNoMask(const py::object& object, const char* name) {
  if (!py::isinstance(object, py::module_::import("numpy.ma").attr("MaskedArray"))) return;
  Fail(name, "an array without a mask",
       "a masked array; give the rows that are not masked, or, of floats, "
       "array.filled(numpy.nan): a point of NaN is a missing return");
}

/// Whatever numpy makes an array of.
py::array Array(const py::object& object, const char* name) {
  RequireNoMask(object, name);
  py::array array = py::array::ensure(object);
  if (!array) Fail(name, "an array", py::str(py::type::of(object).attr("__name__")));
  return array;
}

std::string TypeText(const py::array& array) {
  return "an array of " + std::string(py::str(array.dtype()));
}

/// An array of float32 is taken as it is, one of other real numbers as float64.
py::array RealArray(const py::object& object, const char* name) {
  const py::array array = Array(object, name);
  if (array.dtype().kind() != 'f') Fail(name, "float32 or float64", TypeText(array));
  if (py::isinstance<py::array_t<float>>(array)) return array;
  return py::array_t<double>::ensure(array);
}

/// By memcpy, as views into records need not be aligned.
template <typename T>
T Load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof(value));
  return value;
}

template <typename T>
void CopyPoints(const py::array& array, std::vector<LidarPoint>* points) {
  const bool has_intensities = array.shape(1) == 4;
  const char* row = static_cast<const char*>(array.data());
  for (LidarPoint& point : *points) {
    for (int i = 0; i < 3; ++i) {
      point.xyz_m[i] = static_cast<float>(Load<T>(row + i * array.strides(1)));
    }
    if (has_intensities) {
      point.intensity = static_cast<float>(Load<T>(row + 3 * array.strides(1)));
    }
    row += array.strides(0);
  }
}

/// From a number to the next larger one of this size in bytes.
double Spacing(double number, py::ssize_t size) {
  if (number == 0.0 || !std::isfinite(number)) return 0.0;
  constexpr int kHalf = 10, kSingle = 23;  // Bits behind the first one.
  return std::ldexp(1.0, std::ilogb(number) - (size < 4 ? kHalf : kSingle));
}

void RequireList(const py::array& array, const char* name) {
  if (array.ndim() > 1) Fail(name, "of shape (N,)", "the shape " + ShapeText(array));
}

SE3 PoseFrom(const double* m, const std::string& name) {
  Eigen::Matrix4d T;
  for (int i = 0; i < 16; ++i) T(i / 4, i % 4) = m[i];
  if (!T.allFinite()) Fail(name, "finite", "NaN or infinity");
  if (!T.row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0), 1e-9)) {
    Fail(name, "transforms with the last row 0 0 0 1", "another last row");
  }
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error > 1e-3 || R.determinant() < 0.0) {
    Fail(name, "transforms whose 3x3 part is a rotation",
         "RᵀR that differs from I by " + std::to_string(error) + ", and the determinant " +
             std::to_string(R.determinant()));
  }
  return {Eigen::Quaterniond(R).normalized(), T.topRightCorner<3, 1>()};
}

void WritePose(const SE3& pose, double* m) {
  const Eigen::Matrix3d R = pose.q.toRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) m[4 * row + column] = R(row, column);
    m[4 * row + 3] = pose.t[row];
  }
  m[12] = m[13] = m[14] = 0.0;
  m[15] = 1.0;
}

/// Numbers that numpy keeps as int64 or uint64, row by row.
py::array_t<std::int64_t> Int64Array(const py::array& array, const char* name) {
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u') Fail(name, "whole numbers (int64)", TypeText(array));
  if (kind == 'u' && array.itemsize() == 8 && array.size() > 0) {
    const py::object too_large = array.attr("__gt__")(std::int64_t{0x7FFFFFFFFFFFFFFF});
    if (py::cast<bool>(too_large.attr("any")())) Fail(name, "within int64", "larger numbers");
  }
  return py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
}

}  // namespace

bool ReadPoints(const py::object& object, std::vector<LidarPoint>* points) {
  const py::array given = Array(object, "points");
  if (given.dtype().kind() == 'i' || given.dtype().kind() == 'u') {
    Fail("points", "float32 or float64",
         TypeText(given) +
             ": whole numbers are mostly millimetres, and metres are needed (0.001 * points, or "
             "points.astype(float) if they are metres)");
  }
  const py::array array = RealArray(given, "points");
  if (array.ndim() != 2 || (array.shape(1) != 3 && array.shape(1) != 4)) {
    Fail("points", "of shape (N, 3): x, y, z in metres, or (N, 4) with intensities",
         "the shape " + ShapeText(array));
  }
  points->resize(static_cast<std::size_t>(array.shape(0)));
  if (py::isinstance<py::array_t<float>>(array)) {
    CopyPoints<float>(array, points);
  } else {
    CopyPoints<double>(array, points);
  }
  return array.shape(1) == 4;
}

std::vector<double> ReadReals(const py::object& object, const char* name) {
  const py::array array = Array(object, name);
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') Fail(name, "numbers", TypeText(array));
  RequireList(array, name);
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  return {numbers.data(), numbers.data() + numbers.size()};
}

void RequireFineSeconds(const py::object& object, const char* name, const std::string& instead) {
  constexpr double kCoarsest_s = 1e-6;
  const py::array array = Array(object, name);
  if (array.dtype().kind() != 'f' || array.itemsize() >= 8) return;
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  for (py::ssize_t i = 0; i < numbers.size(); ++i) {
    const double spacing_s = Spacing(numbers.data()[i], array.itemsize());
    if (spacing_s <= kCoarsest_s) continue;
    Fail(name, "float64" + instead,
         FormatText("%s: near %g s its neighbours are %g s apart",
                    std::string(py::str(array.dtype().attr("name"))).c_str(), numbers.data()[i],
                    spacing_s));
  }
}

std::vector<std::int64_t> ReadIntegers(const py::object& object, const char* name) {
  const py::array array = Array(object, name);
  RequireList(array, name);
  const py::array_t<std::int64_t> numbers = Int64Array(array, name);
  return {numbers.data(), numbers.data() + numbers.size()};
}

std::vector<SE3> ReadPoses(const py::object& object, const char* name) {
  const py::array array = RealArray(object, name);
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
    Fail(name, "of shape (N, 4, 4)", "the shape " + ShapeText(array));
  }
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>(array);
  std::vector<SE3> poses;
  poses.reserve(static_cast<std::size_t>(array.shape(0)));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    poses.push_back(
        PoseFrom(numbers.data() + 16 * i, std::string(name) + "[" + std::to_string(i) + "]"));
  }
  return poses;
}

SE3 ReadPose(const py::object& object, const char* name) {
  RequireNoMask(object, name);
  // Lists of whole numbers are fine, too.
  const auto numbers =
      py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(object);
  if (!numbers) Fail(name, "numbers", py::str(py::type::of(object).attr("__name__")));
  if (numbers.ndim() != 2 || numbers.shape(0) != 4 || numbers.shape(1) != 4) {
    Fail(name, "of shape (4, 4)", "the shape " + ShapeText(numbers));
  }
  return PoseFrom(numbers.data(), name);
}

std::string PathText(const py::object& path) {
  return py::cast<std::string>(py::module_::import("os").attr("fsencode")(path));
}

void RefuseUnknown(const py::kwargs& unknown, const std::string& function,
                   const std::vector<std::string>& known) {
  for (const auto& item : unknown) {
    const std::string name = py::str(item.first);
    std::string hint = Suggestion(NearestOrLonger(name, known));
    if (hint.empty()) {
      for (const std::string& other : known) hint += (hint.empty() ? "; it has " : ", ") + other;
    }
    throw py::type_error(function + " has no argument '" + name + "'" + hint);
  }
}

bool IsScalar(const py::object& object) {
  const py::array array = py::array::ensure(object);
  return array && array.ndim() == 0;
}

py::array_t<double> PoseArray(const std::vector<SE3>& poses) {
  py::array_t<double> array(
      {static_cast<py::ssize_t>(poses.size()), py::ssize_t{4}, py::ssize_t{4}});
  double* m = array.mutable_data();
  for (const SE3& pose : poses) {
    WritePose(pose, m);
    m += 16;
  }
  return array;
}

py::array_t<double> PoseArray(const SE3& pose) {
  py::array_t<double> array({4, 4});
  WritePose(pose, array.mutable_data());
  return array;
}

py::array ReadOnlyView(const py::dtype& dtype, const std::vector<py::ssize_t>& shape,
                       const std::vector<py::ssize_t>& strides, const void* data,
                       const py::object& owner) {
  py::array view(dtype, shape, strides, data, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace trajlo::python
