// SPDX-License-Identifier: MIT
#include "core/config/edit_distance.h"

#include <algorithm>

namespace trajlo {

int EditDistance(std::string_view a, std::string_view b) {
  // Optimal string alignment: rows of the table for a[0, i - 2), a[0, i - 1) and a[0, i).
  std::vector<int> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) previous[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, previous);
    std::swap(previous, row);
  }
  return previous[b.size()];
}

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
