// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/options/edit_distance.h"

namespace trajlo {

/// The end of a message about a word that there is not: "; did you mean 'right'?". Empty if `right`
/// is. What stands before and after it is what stands around the wrong word in the message: quotes,
/// or the dashes of a flag.
inline std::string Suggestion(const std::string& right, const std::string& before = "'",
                              const std::string& after = "'") {
  return right.empty() ? "" : "; did you mean " + before + right + after + "?";
}

/// The same with the one of `names` that is nearest to the word; empty if none is near.
inline std::string DidYouMean(const std::string& word, const std::vector<std::string>& names) {
  return Suggestion(NearestKey(word, names));
}

}  // namespace trajlo
