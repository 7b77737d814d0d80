// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace trajlo {

/// A configuration that cannot be used. The message says where (file:line:column or --set), what
/// was found there, and what is allowed.
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(const std::string& what) : std::runtime_error(what) {}
  ConfigError(const std::string& where, const std::string& what)
      : std::runtime_error(where + ": " + what) {}
};

}  // namespace trajlo
