// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

// Each adds a few classes or functions to the module, in the file of its name. The classes that
// users meet are in the Python package around it.
namespace trajlo::python {

void BindConfig(pybind11::module_* module);
void BindScan(pybind11::module_* module);
void BindTrajectory(pybind11::module_* module);
void BindReader(pybind11::module_* module);
void BindWindow(pybind11::module_* module);
void BindOdometry(pybind11::module_* module);
void BindEvaluation(pybind11::module_* module);
void BindSimulator(pybind11::module_* module);

}  // namespace trajlo::python
