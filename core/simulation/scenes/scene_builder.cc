// SPDX-License-Identifier: MIT
#include "core/simulation/scenes/scene_builder.h"

#include <map>
#include <stdexcept>

namespace trajlo::simulation {

namespace {

using Builder = SceneBlueprint (*)(std::uint64_t seed);

const std::map<std::string, Builder>& Builders() {
  static const std::map<std::string, Builder> builders = {
      {"atrium", BuildAtrium},
      {"car_park", BuildCarPark},
      {"construction_site", BuildConstructionSite},
      {"corridor", BuildCorridor},
      {"courtyard", BuildCourtyard},
      {"facade", BuildFacade},
      {"forest", BuildForest},
      {"hall", BuildHall},
      {"long_facade", BuildLongFacade},
      {"manhattan", BuildManhattan},
      {"motorway", BuildMotorway},
      {"office", BuildOffice},
      {"square", BuildSquare},
      {"stairwell", BuildStairwell},
      {"street", BuildStreet},
      {"tall_room", BuildTallRoom},
  };
  return builders;
}

}  // namespace

SceneBlueprint BuildScene(const std::string& name, std::uint64_t seed) {
  const auto builder = Builders().find(name);
  if (builder == Builders().end()) throw std::invalid_argument("unknown scene '" + name + "'");
  return builder->second(seed);
}

std::vector<std::string> SceneNames() {
  std::vector<std::string> names;
  for (const auto& [name, builder] : Builders()) names.push_back(name);
  return names;
}

}  // namespace trajlo::simulation
