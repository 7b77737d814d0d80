// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace trajlo {

/// Pairs (i, j) of stamps a[i] and b[j], in the order of time, as associate.py of the TUM RGB-D
/// benchmark forms them: of all pairs whose difference is BELOW the largest one, the pair with the
/// smallest difference first (at a tie the earlier a, then the earlier b), and neither of its
/// stamps a second time. Differences are RoundedDistance_s(), as the script sees them; which of
/// several stamps that are the same gets a partner is not defined.
/// Neither a nor b decreases. O(n log n), whatever the largest difference.
std::vector<std::pair<std::size_t, std::size_t>> PairOneToOne(const std::vector<std::int64_t>& a_ns,
                                                              const std::vector<std::int64_t>& b_ns,
                                                              double max_difference_s);

}  // namespace trajlo
