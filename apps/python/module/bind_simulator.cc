// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/python/module/exclusive.h"
#include "apps/python/module/flagged_trajectory.h"
#include "core/config/config_error.h"
#include "core/simulation/scan_stream.h"
#include "core/simulation/scenario_parameters.h"
#include "core/simulation/simulator.h"

namespace trajlo::python {
namespace {

using simulation::Scenario;
using simulation::Simulator;

/// The truth is told as often as in truth.tum.
constexpr std::int64_t kTruthStep_ns = 1'000'000;

struct Parameters {
  std::optional<std::int64_t> seed;
  std::optional<double> duration_s;
  std::vector<std::pair<std::string, std::string>> others;
};

Scenario MakeScenario(const std::string& name, const Parameters& parameters) {
  Scenario scenario = simulation::MakeScenario(name);
  if (parameters.duration_s) scenario.duration_s = *parameters.duration_s;
  if (parameters.seed) {
    if (*parameters.seed < 0) throw std::invalid_argument("seed: must not be negative");
    scenario.seed = static_cast<std::uint64_t>(*parameters.seed);
  }
  simulation::SetParameters(&scenario, parameters.others);
  if (!(scenario.duration_s > 0.0 && scenario.duration_s <= simulation::kLongestDuration_s)) {
    throw std::invalid_argument("duration_s: must be positive and at most 86400 s, found " +
                                std::to_string(scenario.duration_s));
  }
  return scenario;
}

std::shared_ptr<Simulator> MakeSimulator(
    const std::string& name, const std::optional<std::int64_t>& seed,
    const std::optional<double>& duration_s,
    const std::vector<std::pair<std::string, std::string>>& others) {
  const py::gil_scoped_release release;
  try {
    return std::make_shared<Simulator>(MakeScenario(name, {seed, duration_s, others}));
  } catch (const std::exception& error) {
    // A scenario that cannot be made: its name, a parameter, or a file that it names.
    throw ConfigError(error.what());
  }
}

FlaggedTrajectory Truth(const Simulator& simulator) {
  const py::gil_scoped_release release;
  FlaggedTrajectory truth;
  for (std::int64_t t = simulator.start_ns(); t <= simulator.end_ns(); t += kTruthStep_ns) {
    truth.Append({t, simulator.TrueWorldFromBody(t), 0});
  }
  return truth;
}

std::vector<py::array_t<double>> Extrinsics(const Simulator& simulator) {
  std::vector<py::array_t<double>> poses;
  for (const auto& lidar : simulator.scenario().rig) {
    poses.push_back(PoseArray(lidar.T_body_lidar));
  }
  return poses;
}

/// The pose of each LiDAR as [qx qy qz qw x y z].
std::vector<std::vector<double>> Rig(const Simulator& simulator) {
  std::vector<std::vector<double>> poses;
  for (const auto& lidar : simulator.scenario().rig) {
    const double* pose = lidar.T_body_lidar.data();
    poses.emplace_back(pose, pose + 7);
  }
  return poses;
}

std::int64_t ScanCount(const Simulator& simulator) {
  std::int64_t count = 0;
  for (int id = 0; id < static_cast<int>(simulator.scenario().rig.size()); ++id) {
    count += simulator.ScanCount(id);
  }
  return count;
}

/// The scans of one pass, simulated without the GIL when they are asked for.
class Stream {
 public:
  Stream(std::shared_ptr<Simulator> simulator, int threads)
      : simulator_(std::move(simulator)), stream_(*simulator_, threads) {}

  std::shared_ptr<LidarScan> Next() {
    simulation::SimulatedScan simulated;
    if (!Simulate(&simulated)) throw py::stop_iteration();
    return std::make_shared<LidarScan>(std::move(simulated.scan));
  }

 private:
  bool Simulate(simulation::SimulatedScan* simulated) {
    const Exclusive::Claim claim(&exclusive_);
    const py::gil_scoped_release release;
    return stream_.Next(simulated);
  }

  std::shared_ptr<Simulator> simulator_;
  simulation::ScanStream stream_;
  Exclusive exclusive_;
};

py::dict ScenariosWithMeaning() {
  py::dict scenarios;
  for (const std::string& name : simulation::ScenarioNames()) {
    scenarios[py::str(name)] = simulation::MakeScenario(name).description;
  }
  return scenarios;
}

}  // namespace

void BindSimulator(py::module_* module) {
  py::class_<Simulator, std::shared_ptr<Simulator>>(*module, "Simulator", "A scenario, alive.")
      .def(py::init(&MakeSimulator), py::arg("scenario"), py::arg("seed"), py::arg("duration_s"),
           py::arg("parameters"))
      .def("truth", &Truth)
      .def("T_body_lidar", &Extrinsics)
      .def("scan_count", &ScanCount)
      .def("rig", &Rig)
      .def("parameters", [](const Simulator& simulator) {
        Scenario scenario = simulator.scenario();
        py::dict texts;
        for (const auto& parameter : simulation::Parameters(&scenario)) {
          texts[py::str(parameter.key)] = ParameterText(parameter);
        }
        return texts;
      });
  py::class_<Stream>(*module, "Stream", "The scans of one pass through a simulation.")
      .def(py::init<std::shared_ptr<Simulator>, int>(), py::arg("simulator"), py::arg("threads"))
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__", &Stream::Next);
  module->def("scenarios", &ScenariosWithMeaning, "{name: description} of all scenarios.");
}

}  // namespace trajlo::python
