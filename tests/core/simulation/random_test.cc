// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/simulation/random/counter_random.h"

namespace trajlo::simulation {
namespace {

TEST(CounterRandom, DependsOnItsKeyAlone) {
  CounterRandom a(1, 2, 3, 4);
  CounterRandom other(1, 2, 3, 5);
  other.Uniform();
  CounterRandom b(1, 2, 3, 4);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.Gaussian(), b.Gaussian());
  EXPECT_NE(CounterRandom(1, 2, 3, 4).Uniform(), CounterRandom(1, 2, 4, 3).Uniform());
}

TEST(CounterRandom, FirstDrawsOfNeighbouringKeysAreUniformAndIndependent) {
  // The simulator draws a few numbers for each of millions of keys: they must look random across
  // keys, not only along one stream.
  constexpr int kKeys = 200'000;
  double sum = 0.0;
  double squares = 0.0;
  double products = 0.0;
  double previous = 0.0;
  for (int i = 0; i < kKeys; ++i) {
    const double u = CounterRandom(7, 0, 5, static_cast<std::uint64_t>(i)).Uniform() - 0.5;
    ASSERT_GE(u, -0.5);
    ASSERT_LT(u, 0.5);
    sum += u;
    squares += u * u;
    products += u * previous;
    previous = u;
  }
  const double deviation = 1.0 / std::sqrt(12.0 * kKeys);
  EXPECT_NEAR(sum / kKeys, 0.0, 4.0 * deviation);
  EXPECT_NEAR(squares / kKeys, 1.0 / 12.0, 0.001);
  EXPECT_NEAR(products / kKeys, 0.0, 4.0 / (12.0 * std::sqrt(kKeys)));
}

TEST(CounterRandom, GaussiansHaveTheMomentsOfOne) {
  constexpr int kDraws = 200'000;
  double moments[5] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double g = CounterRandom(3, 1, 4, static_cast<std::uint64_t>(i)).Gaussian();
    double power = 1.0;
    for (double& moment : moments) {
      moment += power / kDraws;
      power *= g;
    }
  }
  EXPECT_NEAR(moments[1], 0.0, 0.01);
  EXPECT_NEAR(moments[2], 1.0, 0.015);
  EXPECT_NEAR(moments[3], 0.0, 0.05);
  EXPECT_NEAR(moments[4], 3.0, 0.15);
}

}  // namespace
}  // namespace trajlo::simulation
