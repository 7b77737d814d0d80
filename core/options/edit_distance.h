// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trajlo {

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn a into b.
inline int EditDistance(std::string_view a, std::string_view b) {
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

/// The first of the candidates whose distance(candidate) is least; empty if none is below `limit`.
template <typename Distance>
std::string NearestBelow(int limit, const std::vector<std::string>& candidates,
                         const Distance& distance) {
  std::string nearest;
  for (const std::string& candidate : candidates) {
    const int found = distance(candidate);
    if (found >= limit) continue;
    limit = found;
    nearest = candidate;
  }
  return nearest;
}

/// The candidate that `word` most likely stands for: by the whole dotted key, or by its last part
/// alone when the section was forgotten or is another one. Empty if none is close.
inline std::string NearestKey(std::string_view word, const std::vector<std::string>& candidates) {
  const auto last_part = [](std::string_view key) { return key.substr(key.rfind('.') + 1); };
  const std::string_view last = last_part(word);
  const int limit = std::max(2, static_cast<int>(last.size()) / 3) + 1;
  return NearestBelow(limit, candidates, [&](std::string_view candidate) {
    // A whole key that is as close as a last part alone is the better guess.
    return std::min(EditDistance(word, candidate), EditDistance(last, last_part(candidate)) + 1);
  });
}

/// The same for words that may be cut short: 'hall_os1' is as good as the beginning of hall_os1_16,
/// and 'motion.sped' as that of motion.speed_mps.
inline std::string NearestOrLonger(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  const int limit = static_cast<int>(word.size()) / 3 + 2;
  return NearestBelow(limit, candidates, [&](std::string_view candidate) {
    return std::min(EditDistance(word, candidate),
                    EditDistance(word, candidate.substr(0, word.size())) + 1);
  });
}

}  // namespace trajlo
