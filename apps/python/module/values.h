// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

// Single values that a user may pass as an argument. pybind11 alone would list the types of all
// arguments of the function; these throw TypeError, which names the one argument, what it must be
// and what was found. A bool is no number.
namespace trajlo::python {

namespace py = pybind11;

/// A float, an int, or a number of numpy's; nothing for None.
std::optional<double> ReadReal(const py::object& value, const char* name);
/// A str; nothing for None.
std::optional<std::string> ReadText(const py::object& value, const char* name);
/// An int, or a whole number of numpy's; the nearest that an int of C++ holds.
int ReadWhole(const py::object& value, const char* name);

}  // namespace trajlo::python
