// SPDX-License-Identifier: MIT
// trajlo._trajlo: the compiled half of the Python package.
#include <gflags/gflags.h>
#include <pybind11/pybind11.h>

#include "apps/python/module/bindings.h"
#include "apps/python/module/errors.h"
#include "core/report/versions.h"

PYBIND11_MODULE(_trajlo, module) {
  using namespace trajlo::python;
  module.doc() = "The compiled half of trajlo; import trajlo instead.";
  // Ceres reports each failed step as a warning; what is done about it stands in the results.
  gflags::SetCommandLineOptionWithMode("minloglevel", "2", gflags::SET_FLAGS_DEFAULT);
  const trajlo::Versions versions = trajlo::GetVersions();
  module.attr("version") = versions.trajlo;
  module.attr("commit") = versions.git;
  TranslateErrors();
  BindConfig(&module);
  BindScan(&module);
  BindTrajectory(&module);
  BindReader(&module);
  BindWindow(&module);
  BindOdometry(&module);
  BindEvaluation(&module);
  BindSimulator(&module);
}
