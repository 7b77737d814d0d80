// SPDX-License-Identifier: MIT
#include "core/simulation/scenario_yaml.h"

#include "core/io/format_text.h"
#include "core/io/rig_yaml.h"
#include "core/simulation/scenario_parameters.h"

namespace trajlo::simulation {

namespace {

std::string MatrixText(const SE3& T) {
  const Eigen::Matrix3d R = T.q.toRotationMatrix();
  std::string text = "[";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      text += FormatText("%.12g, ", column < 3 ? R(row, column) : T.t[row]);
    }
  }
  return text + "0, 0, 0, 1]";
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

std::string Scalar(const Parameter& parameter) {
  const std::string text = ParameterText(parameter);
  return std::holds_alternative<Word>(parameter.value) ? Quoted(text) : text;
}

}  // namespace

std::string ScenarioYaml(const Scenario& scenario) {
  Scenario copy = scenario;  // Parameters hands out pointers that could write.
  std::string yaml =
      "# A simulated recording. Metres, radians and seconds unless a key says otherwise.\n";
  yaml += "name: " + Quoted(copy.name) + "\ndescription: " + Quoted(copy.description) + "\n";
  std::string group;
  for (const Parameter& parameter : Parameters(&copy)) {
    const std::size_t dot = parameter.key.find('.');
    const std::string prefix = dot == std::string::npos ? "" : parameter.key.substr(0, dot);
    if (prefix != group) yaml += prefix + ":\n";
    group = prefix;
    const std::string name =
        dot == std::string::npos ? parameter.key : parameter.key.substr(dot + 1);
    const std::string indent = group.empty() ? "" : "  ";
    if (const auto* const* T = std::get_if<SE3*>(&parameter.value)) {
      yaml += indent + "# x, y, z (m), qx, qy, qz, qw; then the same as a row-major 4x4 matrix\n";
      yaml += indent + name + ": [" + ParameterText(parameter) + "]\n";
      yaml += indent + name + "_matrix: " + MatrixText(**T) + "\n";
    } else {
      yaml += indent + name + ": " + Scalar(parameter) + "\n";
    }
  }
  return yaml;
}

std::string RigYaml(const Scenario& scenario) {
  std::vector<SE3> T_body_lidar;
  for (const LidarConfig& lidar : scenario.rig) T_body_lidar.push_back(lidar.T_body_lidar);
  return trajlo::RigYaml("The true extrinsics of " + scenario.name + ", for trajlo_run --config=",
                         T_body_lidar);
}

}  // namespace trajlo::simulation
