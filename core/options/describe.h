// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace trajlo {

/// Who meets an option: everyone who runs recordings, or those who study the estimator. Keys of
/// the latter begin with `expert.`.
enum class OptionFor { kUsers, kExperts };

/// The key of an option in a section such as "window", which may be empty.
inline std::string OptionKey(OptionFor audience, const std::string& section,
                             const std::string& name) {
  return (audience == OptionFor::kExperts ? "expert." : "") +
         (section.empty() ? "" : section + ".") + name;
}

/// What a number may be.
template <typename T>
struct Range {
  T min, max;
};

/// The words of a choice, and what they mean.
template <typename Value>
using Names = std::vector<std::pair<const char*, Value>>;

// An options struct has one place for the name, the bounds and the meaning of its fields:
//
//   template <typename Describer>
//   void Describe(Describer& d) {
//     d(OptionFor::kUsers, "segments", segments, Range<int>{1, 100}, "Segments that are ...");
//   }
//
// From it come the YAML keys, --set, the checks and `--show_config`.

}  // namespace trajlo
