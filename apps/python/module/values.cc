// SPDX-License-Identifier: MIT
#include "apps/python/module/values.h"

#include <algorithm>
#include <limits>

namespace trajlo::python {
namespace {

[[noreturn]] void Refuse(const py::object& value, const std::string& name, const char* expected) {
  throw py::type_error(name + ": must be " + expected + ", found " +
                       std::string(py::str(py::type::of(value).attr("__name__"))));
}

/// After a call of Python's that may have failed: a TypeError is put in our words.
void RequireSuccess(const py::object& value, const char* name, const char* expected) {
  if (PyErr_Occurred() == nullptr) return;
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  Refuse(value, name, expected);
}

}  // namespace

std::optional<double> ReadReal(const py::object& value, const char* name) {
  constexpr char kExpected[] = "a number or None";
  if (value.is_none()) return {};
  if (py::isinstance<py::bool_>(value)) Refuse(value, name, kExpected);
  const double number = PyFloat_AsDouble(value.ptr());
  RequireSuccess(value, name, kExpected);
  return number;
}

std::optional<std::string> ReadText(const py::object& value, const char* name) {
  if (value.is_none()) return {};
  if (!py::isinstance<py::str>(value)) Refuse(value, name, "a str or None");
  return py::cast<std::string>(value);
}

int ReadWhole(const py::object& value, const char* name) {
  constexpr char kExpected[] = "a whole number";
  if (py::isinstance<py::bool_>(value)) Refuse(value, name, kExpected);
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  RequireSuccess(value, name, kExpected);
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  using Limits = std::numeric_limits<int>;
  if (overflow != 0) return overflow < 0 ? Limits::min() : Limits::max();
  return static_cast<int>(std::clamp<long long>(number, Limits::min(), Limits::max()));
}

}  // namespace trajlo::python
