// SPDX-License-Identifier: MIT
#include "core/config/edit_distance.h"

#include <algorithm>

namespace trajlo {

std::string NearestKey(std::string_view word, const std::vector<std::string>& candidates) {
  const auto last_part = [](std::string_view key) { return key.substr(key.rfind('.') + 1); };
  const std::string_view last = last_part(word);
  std::string nearest;
  int best = std::max(2, static_cast<int>(last.size()) / 3) + 1;
  for (const std::string& candidate : candidates) {
    // A whole key that is as close as a last part alone is the better guess.
    const int whole = EditDistance(word, candidate);
    const int by_last_part = EditDistance(last, last_part(candidate)) + 1;
    const int distance = std::min(whole, by_last_part);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace trajlo
