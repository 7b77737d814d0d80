// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>

namespace trajlo {

/// How the messages of a type are built, as a bag says it.
struct BagDefinition {
  std::string md5sum = "*";
  std::string definition;
};

/// The definitions in a ROS 1 bag, by topic and type. A damaged bag is searched to its end.
std::map<std::pair<std::string, std::string>, BagDefinition> ReadBagDefinitions(
    const std::filesystem::path& bag);

}  // namespace trajlo
