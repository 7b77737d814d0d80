// SPDX-License-Identifier: MIT
#include "core/odometry/health/lone_object.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trajlo {
namespace {

constexpr double kWindow_s = 0.03;

/// What one window sees: the ground and both walls of a road along x, which hold all but the way
/// along it, and what faces the way.
struct Seen {
  int truck = 30;           ///< Points on a surface 3 m wide, 10 m ahead, ...
  double truck_m = 0.01;    ///< ... so far from its plane.
  int passing = 6;          ///< Others, far apart on both sides, ...
  double passing_m = 0.15;  ///< ... so far from theirs.
  int second = 0;           ///< On another surface, 40 m ahead, as far from it as those.
  double truck_weight = 1.0;
};

void Add(const Eigen::Vector3d& p, const Eigen::Vector3d& normal, double distance_m, double weight,
         Segment* segment) {
  segment->points.push_back({p, 0.5, normal, normal.dot(p) - distance_m, weight, 0.0});
}

Window WindowAt(int i, const Seen& seen) {
  Window window;
  window.begin_ns = std::llround(i * kWindow_s * 1e9);
  window.segments.resize(1);
  Segment& segment = window.segments[0];
  segment.cloud.begin_ns = window.begin_ns;
  segment.cloud.end_ns = window.begin_ns + std::llround(kWindow_s * 1e9);
  using Eigen::Vector3d;
  for (int k = 0; k < 800; ++k) {
    Add({0.04 * k, 5.0, 1.0}, Vector3d::UnitY(), 0.0, 1.0, &segment);
  }
  for (int k = 0; k < 800; ++k) {
    Add({0.04 * k, 1.0, -2.0}, Vector3d::UnitZ(), 0.0, 1.0, &segment);
  }
  for (int k = 0; k < seen.truck; ++k) {
    const double y = 3.0 * (k + 0.5) / seen.truck - 1.5;
    Add({10.0, y, 0.5}, -Vector3d::UnitX(), seen.truck_m, seen.truck_weight, &segment);
  }
  for (int k = 0; k < seen.passing; ++k) {
    Add({5.0 + 4.0 * k, k % 2 == 0 ? 4.9 : -4.9, 1.0}, -Vector3d::UnitX(), seen.passing_m, 1.0,
        &segment);
  }
  for (int k = 0; k < seen.second; ++k) {
    Add({40.0, 0.01 * k, 1.0}, -Vector3d::UnitX(), seen.passing_m, 1.0, &segment);
  }
  return window;
}

/// Windows of one kind, one after the other.
class Road {
 public:
  /// For how many of the next windows it is noticed.
  int Noticed(int windows, const Seen& seen) {
    int noticed = 0;
    while (windows-- > 0) noticed += watch_.IsContradicted(WindowAt(next_++, seen)) ? 1 : 0;
    return noticed;
  }

 private:
  LoneObjectWatch watch_;
  int next_ = 0;
};

TEST(LoneObject, WhatHoldsTheBodyAloneAndIsContradictedIsNoticed) {
  Road road;
  // It takes a few windows until enough has passed by.
  EXPECT_EQ(road.Noticed(5, {}), 0);
  EXPECT_EQ(road.Noticed(100, {}), 100);
}

TEST(LoneObject, TheEndOfAStreetIsConfirmedByWhatElseFacesIt) {
  Seen seen;
  seen.passing_m = 0.02;
  EXPECT_EQ(Road().Noticed(100, seen), 0);
}

TEST(LoneObject, WhereNothingElseFacesTheWayNothingCanTell) {
  Seen seen;
  seen.passing = 0;
  EXPECT_EQ(Road().Noticed(100, seen), 0);
}

TEST(LoneObject, OfTwoObjectsThatContradictEachOtherNeitherIsAlone) {
  Seen seen;
  seen.second = 14;
  EXPECT_EQ(Road().Noticed(100, seen), 0);
}

TEST(LoneObject, WherePointsAreNoisyThoseOfTheObjectAreToo) {
  Seen seen;
  seen.truck_m = 0.1;
  EXPECT_EQ(Road().Noticed(100, seen), 0);
}

TEST(LoneObject, ADirectionThatManyNormalsFaceIsHeldByMore) {
  Seen seen;
  seen.truck = 150;
  seen.passing = 10;
  EXPECT_EQ(Road().Noticed(100, seen), 0);
}

TEST(LoneObject, WhatIsConfirmedAgainIsForgottenInSeconds) {
  Road road;
  ASSERT_EQ(road.Noticed(405, {}), 400);
  Seen confirmed;
  confirmed.passing_m = 0.02;
  const int noticed = road.Noticed(200, confirmed);
  EXPECT_GT(noticed * kWindow_s, 0.3);
  EXPECT_LT(noticed * kWindow_s, 2.0);
}

TEST(LoneObject, WithoutPointsOrWeightsNothingIsNoticed) {
  Road road;
  Seen nothing;
  nothing.truck = nothing.passing = 0;
  EXPECT_EQ(road.Noticed(50, nothing), 0);
  Seen silenced;
  silenced.truck_weight = 0.0;
  EXPECT_EQ(road.Noticed(50, silenced), 0);
  LoneObjectWatch watch;
  EXPECT_FALSE(watch.IsContradicted(Window()));
}

}  // namespace
}  // namespace trajlo
