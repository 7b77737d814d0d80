// SPDX-License-Identifier: MIT
#include "core/evaluation/one_to_one.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

#include "core/evaluation/stamp_search.h"

namespace trajlo {
namespace {

// Nothing lies between the two stamps of the closest pair that is left: it would make a closer one.
// So the stamps of both are a linked list in the order of time, and candidates are its neighbours.

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Stamp {
  std::int64_t t_ns;
  bool of_b;
  std::size_t index;
  std::size_t before, after;
  bool paired = false;
};

std::vector<Stamp> ListOf(const std::vector<std::int64_t>& a_ns,
                          const std::vector<std::int64_t>& b_ns) {
  std::vector<Stamp> list;
  list.reserve(a_ns.size() + b_ns.size());
  for (std::size_t i = 0; i < a_ns.size(); ++i) list.push_back({a_ns[i], false, i, kNone, kNone});
  for (std::size_t i = 0; i < b_ns.size(); ++i) list.push_back({b_ns[i], true, i, kNone, kNone});
  std::stable_sort(list.begin(), list.end(),
                   [](const Stamp& x, const Stamp& y) { return x.t_ns < y.t_ns; });
  for (std::size_t k = 1; k < list.size(); ++k) {
    list[k].before = k - 1;
    list[k - 1].after = k;
  }
  return list;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> PairOneToOne(const std::vector<std::int64_t>& a_ns,
                                                              const std::vector<std::int64_t>& b_ns,
                                                              double max_difference_s) {
  std::vector<Stamp> list = ListOf(a_ns, b_ns);
  // Difference, and the places in the list of the stamps of a and b.
  using Candidate = std::tuple<double, std::size_t, std::size_t>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  const auto consider = [&](std::size_t x, std::size_t y) {
    if (x == kNone || y == kNone || list[x].of_b == list[y].of_b) return;
    const double difference_s = RoundedDistance_s(list[x].t_ns, list[y].t_ns);
    if (!(difference_s < max_difference_s)) return;
    if (list[x].of_b) std::swap(x, y);
    candidates.push({difference_s, x, y});
  };
  for (std::size_t k = 0; k < list.size(); ++k) consider(k, list[k].after);

  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  while (!candidates.empty()) {
    const auto [difference_s, x, y] = candidates.top();
    candidates.pop();
    if (list[x].paired || list[y].paired) continue;
    list[x].paired = list[y].paired = true;
    pairs.emplace_back(list[x].index, list[y].index);
    const std::size_t before = list[std::min(x, y)].before;
    const std::size_t after = list[std::max(x, y)].after;
    if (before != kNone) list[before].after = after;
    if (after != kNone) list[after].before = before;
    consider(before, after);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace trajlo
