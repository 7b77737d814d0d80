// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/config/edit_distance.h"

namespace trajlo {

/// The end of a message about a value that there is not; empty if none of `names` is near.
inline std::string DidYouMean(const std::string& word, const std::vector<std::string>& names) {
  const std::string nearest = NearestKey(word, names);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace trajlo
