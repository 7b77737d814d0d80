// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace trajlo {

/// Input that cannot be used. The message has three parts: where, what was found there, and what
/// the user can do about it.
class InputError : public std::runtime_error {
 public:
  InputError(const std::filesystem::path& path, const std::string& found, const std::string& mend)
      : std::runtime_error(path.string() + ": " + found + (mend.empty() ? "" : "\n  " + mend)) {}
};

/// Output that could not be written completely: no such folder, no permission, disk full, or a
/// file that would be overwritten.
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::filesystem::path& path, const std::string& problem)
      : std::runtime_error(path.string() + ": " + problem) {}
};

}  // namespace trajlo
