// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <new>
#include <string>
#include <system_error>

namespace trajlo {

/// What to tell users of an exception that no command expects.
inline std::string FailureText(const std::exception& error) {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return "there is not enough memory";
  const auto* of_system = dynamic_cast<const std::system_error*>(&error);
  if (of_system != nullptr && of_system->code() == std::errc::resource_unavailable_try_again) {
    return "no thread could be started: memory or the number of threads is limited";
  }
  return std::string("failed: ") + error.what();
}

}  // namespace trajlo
