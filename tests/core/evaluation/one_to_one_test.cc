// SPDX-License-Identifier: MIT
#include "core/evaluation/one_to_one.h"

#include <gmock/gmock.h>

#include <set>
#include <tuple>

#include "core/evaluation/stamp_search.h"
#include "core/scans/nanoseconds.h"
#include "tests/support/random_poses.h"

namespace trajlo::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::vector<std::int64_t> Stamps(const std::vector<double>& t_s) {
  std::vector<std::int64_t> t_ns;
  for (const double t : t_s) t_ns.push_back(Nanoseconds(t));
  return t_ns;
}

/// The rule word for word: every pair below the largest difference, sorted by it.
Pairs EveryPairSorted(const std::vector<std::int64_t>& a_ns, const std::vector<std::int64_t>& b_ns,
                      double max_difference_s) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < a_ns.size(); ++i) {
    for (std::size_t j = 0; j < b_ns.size(); ++j) {
      const double difference_s = RoundedDistance_s(a_ns[i], b_ns[j]);
      if (difference_s < max_difference_s) sorted.emplace_back(difference_s, i, j);
    }
  }
  std::sort(sorted.begin(), sorted.end());
  std::set<std::size_t> used_a, used_b;
  Pairs pairs;
  for (const auto& [difference_s, i, j] : sorted) {
    if (used_a.count(i) || used_b.count(j)) continue;
    used_a.insert(i);
    used_b.insert(j);
    pairs.push_back({i, j});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

TEST(OneToOne, TheClosestPairWinsAndTheOtherTakesWhatIsLeft) {
  // 1.0 and 1.3 both are nearest to 1.2; 1.3 is closer, and 1.0 falls back on 0.6.
  EXPECT_THAT(PairOneToOne(Stamps({1.0, 1.3}), Stamps({0.6, 1.2}), 0.5),
              ElementsAre(Pair(0, 0), Pair(1, 1)));
  EXPECT_THAT(PairOneToOne(Stamps({1.0, 1.3}), Stamps({0.6, 1.2}), 0.3), ElementsAre(Pair(1, 1)));
}

TEST(OneToOne, AnInnerPairIsTakenEvenIfThatLeavesTheOuterOnesFarApart) {
  // Pairing in order would be better for the sum, but the rule is greedy.
  EXPECT_THAT(PairOneToOne(Stamps({0.0, 2.0}), Stamps({1.5, 3.9}), 2.0), ElementsAre(Pair(1, 0)));
  EXPECT_THAT(PairOneToOne(Stamps({0.0, 2.0}), Stamps({1.5, 3.9}), 4.0),
              ElementsAre(Pair(0, 1), Pair(1, 0)));
}

TEST(OneToOne, AtATieTheEarlierStampWins) {
  EXPECT_THAT(PairOneToOne(Stamps({1.0}), Stamps({0.5, 1.5}), 1.0), ElementsAre(Pair(0, 0)));
  EXPECT_THAT(PairOneToOne(Stamps({0.5, 1.5}), Stamps({1.0}), 1.0), ElementsAre(Pair(0, 0)));
}

TEST(OneToOne, ADifferenceOfExactlyTheLargestOneIsDropped) {
  EXPECT_THAT(PairOneToOne(Stamps({1.0, 2.0}), Stamps({1.25, 2.125}), 0.25),
              ElementsAre(Pair(1, 1)));
}

TEST(OneToOne, NothingPairsWithNothing) {
  EXPECT_THAT(PairOneToOne({}, Stamps({1.0}), 1.0), IsEmpty());
  EXPECT_THAT(PairOneToOne(Stamps({1.0}), {}, 1.0), IsEmpty());
  EXPECT_THAT(PairOneToOne({}, {}, 1.0), IsEmpty());
}

TEST(OneToOne, IsTheRuleWordForWordOnRandomStamps) {
  Random random;
  std::size_t contested = 0;
  for (int draw = 0; draw < 200; ++draw) {
    // On a grid, where differences tie, and off it.
    const bool grid = draw % 2 == 0;
    std::set<std::int64_t> a, b;
    for (int i = 0; i < 40; ++i) {
      const double t_s = 1.6e9 + random.Uniform(0.0, 8.0);
      std::set<std::int64_t>& into = random.Uniform(0.0, 1.0) < 0.4 ? a : b;
      into.insert(grid ? Nanoseconds(std::floor(8.0 * t_s) / 8.0) : Nanoseconds(t_s));
    }
    const std::vector<std::int64_t> a_ns(a.begin(), a.end()), b_ns(b.begin(), b.end());
    for (const double max_difference_s : {0.1, 0.3, 10.0}) {
      const Pairs expected = EveryPairSorted(a_ns, b_ns, max_difference_s);
      EXPECT_EQ(PairOneToOne(a_ns, b_ns, max_difference_s), expected) << draw;
      for (const auto& [i, j] : expected) contested += Nearest(b_ns, a_ns[i]) != j;
    }
  }
  EXPECT_GT(contested, 200u);  // Else the nearest stamps would do.
}

}  // namespace
}  // namespace trajlo::testing
