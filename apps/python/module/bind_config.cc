// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/require_extrinsics.h"
#include "core/config/config.h"
#include "core/io/recording/open_recording.h"

namespace trajlo::python {
namespace {

namespace py = pybind11;

py::dict KeysWithMeaning() {
  py::dict keys;
  for (const KeyInfo& info : ListKeys()) {
    py::dict entry;
    entry["allowed"] = info.allowed;
    entry["default"] = info.default_value;
    entry["doc"] = info.doc;
    keys[py::str(info.key)] = entry;
  }
  return keys;
}

/// As trajlo_run does before it reads, where the poses of LiDARs are given.
void CheckExtrinsics(const std::vector<std::string>& inputs, const RunConfig& config) {
  if (!config.odometry.segmenter.T_body_lidar.empty()) RequireExtrinsics(inputs, config);
  RequireOptionsOfEachLidar(inputs, config.input);
}

}  // namespace

void BindConfig(py::module_* module) {
  py::class_<RunConfig>(*module, "Config", "All options, with their defaults.")
      .def(py::init<>())
      .def(
          "load_file",
          [](RunConfig& config, const py::object& path) {
            LoadConfigFile(PathText(path), &config);
          },
          py::arg("path"), "Sets what a YAML file says.")
      .def(
          "load_values",
          [](RunConfig& config, const std::string& yaml, const std::string& name) {
            LoadConfigValues(yaml, name, &config);
          },
          py::arg("yaml"), py::arg("name"), "Sets what a text says; messages begin with the name.")
      .def("check", &CheckConfig, "Raises ConfigError if options contradict each other.")
      .def(
          "dump", [](const RunConfig& config) { return DumpConfig(config); },
          "All options as YAML, with their meaning.");
  module->def("keys", &KeysWithMeaning, "Every option: {key: {allowed, default, doc}}.");
  module->def(
      "input_paths",
      [](const py::object& path) {
        std::vector<py::bytes> paths;
        for (const std::string& input : InputPaths(PathText(path))) paths.emplace_back(input);
        return paths;
      },
      py::arg("path"),
      "The files and folders that a path stands for: lidar0, lidar1, ... of a folder.");
  module->def("check_extrinsics", &CheckExtrinsics, py::arg("inputs"), py::arg("config"),
              "Raises UsageError unless sensor.T_body_lidar is empty or fits the LiDARs read.");
}

}  // namespace trajlo::python
