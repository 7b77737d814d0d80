// SPDX-License-Identifier: MIT
#include "core/odometry/health/doubt.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace trajlo {
namespace {

/// So many points of a floor and of a wall, of all and of those on their planes. Points without a
/// plane come on top.
struct Seen {
  int floor = 500, on_floor = 490;
  int wall = 100, on_wall = 98;
  int without_plane = 0;
};

void AddPoints(const Eigen::Vector3d& normal, int all, int on_plane, Segment* segment) {
  for (int i = 0; i < all; ++i) {
    const double distance_m = i < on_plane ? 0.1 : 0.3;
    segment->points.push_back({distance_m * normal, 0.5, normal, 0.0, 1.0, 0.0});
  }
}

/// A body at rest, one segment of 30 ms that ends at `end_s`.
Window Standing(const Seen& seen, double end_s = 0.03) {
  Window window;
  window.begin_ns = std::llround((end_s - 0.03) * 1e9);
  window.segments.resize(1);
  Segment& segment = window.segments[0];
  segment.cloud.begin_ns = window.begin_ns;
  segment.cloud.end_ns = std::llround(end_s * 1e9);
  AddPoints(Eigen::Vector3d::UnitZ(), seen.floor, seen.on_floor, &segment);
  AddPoints(Eigen::Vector3d(0.6, 0.8, 0.0), seen.wall, seen.on_wall, &segment);
  segment.cloud.registration_points.resize(segment.points.size() +
                                           static_cast<std::size_t>(seen.without_plane));
  return window;
}

MapAgreement Agreement(const Seen& seen) {
  const Window window = Standing(seen);
  return AgreementOf(window, window.segments[0]);
}

TEST(MapAgreement, IsThatOfTheDirectionThatAgreesLeast) {
  const MapAgreement good = Agreement({});
  EXPECT_DOUBLE_EQ(good.on_map, 588.0 / 600.0);
  EXPECT_NEAR(good.worst, 0.98, 0.01);
  // The floor agrees, the wall does not.
  const MapAgreement wrong = Agreement({500, 490, 100, 40, 0});
  EXPECT_NEAR(wrong.worst, (40.0 + 100.0) / (100.0 + 100.0), 1e-9);
  EXPECT_GT(wrong.on_map, 0.85);
}

TEST(DoubtWatch, PointsThatLieOnTheMapMuchWorseThanUsualContradictIt) {
  const DoubtWatch watch;
  EXPECT_FALSE(watch.IsContradicted(Agreement({}).worst));
  EXPECT_TRUE(watch.IsContradicted(Agreement({500, 490, 100, 40, 0}).worst));
  // What has no plane says nothing.
  EXPECT_FALSE(watch.IsContradicted(Agreement({500, 490, 100, 98, 1000}).worst));
}

TEST(MapAgreement, ADirectionThatFewPointsFaceSaysLittle) {
  EXPECT_GT(Agreement({2000, 2000, 4, 0, 0}).worst, 0.95);
  EXPECT_GT(Agreement({20, 20, 1, 0, 0}).worst, 0.95);
  EXPECT_DOUBLE_EQ(Agreement({0, 0, 0, 0, 100}).worst, 1.0);
  EXPECT_DOUBLE_EQ(Agreement({0, 0, 0, 0, 100}).on_map, 0.0);
}

TEST(MapAgreement, PointsWithoutAPlaneAreNotOnTheMapAndDisagreeWithNothing) {
  const MapAgreement half = Agreement({500, 490, 100, 98, 600});
  EXPECT_DOUBLE_EQ(half.on_map, 588.0 / 1200.0);
  EXPECT_NEAR(half.worst, 0.98, 0.01);
}

/// Windows of a body that follow one another.
class Watched {
 public:
  explicit Watched(double density_m2_s3 = 100.0, double density_rad2_s3 = 1e-6) {
    density_ << Eigen::Vector3d::Constant(density_m2_s3),
        Eigen::Vector3d::Constant(density_rad2_s3);
  }

  /// The flags of the doubt after one more window with these flags of its own.
  unsigned Add(unsigned flags, const Seen& seen = {}, bool has_converged = true) {
    return Add(flags, Standing(seen, end_s_ += 0.03), has_converged);
  }
  unsigned Add(unsigned flags, const Window& window, bool has_converged) {
    WindowStatistics statistics;
    statistics.flags = flags;
    statistics.has_converged = has_converged;
    statistics.restless_rounds = has_converged ? 2 : 5;
    statistics.agreement = AgreementOf(window, window.segments.back()).worst;
    watch_.Update(window, statistics, density_);
    return watch_.flags();
  }
  bool MayEnterMap(const Seen& seen) const {
    const Window window = Standing(seen);
    return watch_.MayEnterMap(window, window.segments[0]);
  }
  std::optional<StepSize> Reach(const Seen& newest) const {
    return watch_.Reach(Agreement(newest).worst);
  }
  const std::optional<Eigen::Vector3d>& open_axis() const { return watch_.open_axis_world(); }
  void Dispel() { watch_.Dispel(std::llround(end_s_ * 1e9)); }
  void SetDensity(double m2_s3, double rad2_s3) {
    density_ << Eigen::Vector3d::Constant(m2_s3), Eigen::Vector3d::Constant(rad2_s3);
  }

 private:
  DoubtWatch watch_;
  double end_s_ = 0.0;
  Vector6d density_;
};

/// A body that was held, and then was not for so long that it is in doubt.
Watched InDoubt(const Seen& usual = {}) {
  Watched body;
  for (int i = 0; i < 200; ++i) body.Add(0, usual);
  body.Add(kFlagDegenerate);
  EXPECT_EQ(body.Add(kFlagNoPoints), +kFlagNoPoints);
  return body;
}

const Seen kNewPart{500, 490, 100, 98, 1000};
const Seen kPartlyNew{500, 490, 100, 98, 300};
const Seen kWrongWall{500, 490, 100, 20, 0};

/// How many windows in a row that points do not hold raise a doubt.
int WindowsUntilDoubt(double density_m2_s3, double density_rad2_s3) {
  Watched body(density_m2_s3, density_rad2_s3);
  body.Add(0);
  int windows = 1;
  while (body.Add(kFlagDegenerate) == 0 && windows < 1000) ++windows;
  return windows;
}

TEST(DoubtWatch, BeginsWhenTheBodyMayHaveMovedOffItsPlanes) {
  // 3 sqrt(q t³ / 3) is 0.2 m after 0.237 s with q = 1 m²/s³, after 0.051 s with 100.
  EXPECT_EQ(WindowsUntilDoubt(1.0, 1e-6), 8);
  EXPECT_EQ(WindowsUntilDoubt(100.0, 1e-6), 2);
  // And 0.09 rad after 0.139 s with 1 rad²/s³.
  EXPECT_EQ(WindowsUntilDoubt(1e-6, 1.0), 5);
}

TEST(DoubtWatch, ABodyThatWasNeverHeldMayMoveAtAnySpeed) {
  Watched body(1e-6, 1e-6);
  EXPECT_EQ(body.Add(kFlagNoPoints), +kFlagNoPoints);
  EXPECT_TRUE(body.MayEnterMap(kNewPart)) << "or there would never be a map";
}

TEST(DoubtWatch, ADirectionThatIsOpenFromTheStartIsNoReasonAtOnce) {
  Watched body(1e-6, 1e-6);
  EXPECT_EQ(body.Add(kFlagDegenerate), 0U);
}

TEST(DoubtWatch, AWindowThatIsHeldBeginsTheTimeAnew) {
  Watched body;
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(body.Add(0), 0U);
    EXPECT_EQ(body.Add(kFlagDegenerate), 0U);
  }
}

TEST(DoubtWatch, LastsUntilAWindowHasSettledOnTheMap) {
  Watched body = InDoubt();
  EXPECT_EQ(body.Add(0, kWrongWall), +kFlagNoPoints);
  EXPECT_EQ(body.Add(0, kNewPart), +kFlagNoPoints) << "it may be anywhere";
  EXPECT_EQ(body.Add(0, kPartlyNew), +kFlagNoPoints) << "two thirds are on the map";
  EXPECT_EQ(body.Add(kFlagNotConverged, Seen(), false), +kFlagNoPoints);
  EXPECT_EQ(body.Add(kFlagReverted), +kFlagReverted);
  EXPECT_EQ(body.Add(0), 0U);
  EXPECT_EQ(body.Add(0, kNewPart), 0U) << "a new part of the world, from one that is known";
}

TEST(DoubtWatch, BeginsBehindAPauseIfTheWindowThereDoesNotSettle) {
  for (const bool is_pause : {false, true}) {
    for (const bool settles : {false, true}) {
      Watched body;
      body.Add(0);  // Until 0.03 s.
      Window window = Standing({}, 0.03);
      window.segments.push_back(window.segments[0]);
      window.segments[1].cloud.begin_ns = 30'000'000;
      window.segments[1].cloud.end_ns = is_pause ? 130'000'000 : 100'000'000;
      const unsigned flags = body.Add(0, window, settles);
      EXPECT_EQ(flags, is_pause && !settles ? +kFlagGap : 0U);
      if (flags == 0) continue;
      EXPECT_EQ(body.Add(0, kWrongWall), +kFlagGap);
      EXPECT_EQ(body.Add(0), 0U);
    }
  }
}

TEST(DoubtWatch, EverySegmentOfTheWindowMustAgree) {
  Watched body = InDoubt();
  Window window = Standing({}, 10.0);
  window.segments.push_back(window.segments[0]);
  Window one_is_wrong = window;
  one_is_wrong.segments[0] = Standing(kWrongWall, 10.0).segments[0];
  EXPECT_NE(body.Add(0, one_is_wrong, true), 0U);
  EXPECT_EQ(body.Add(0, window, true), 0U);
}

TEST(DoubtWatch, AgreementIsMeasuredByWhatIsUsual) {
  // Leaves, people: three tenths of what stands upright are never on their planes.
  const Seen restless{500, 490, 100, 70, 0};
  EXPECT_NE(InDoubt().Add(0, restless), 0U);
  EXPECT_EQ(InDoubt(restless).Add(0, restless), 0U);
  EXPECT_NE(InDoubt(restless).Add(0, kWrongWall), 0U);
}

TEST(DoubtWatch, AnOpenDirectionAloneDoesNotKeepTheMapFromGrowing) {
  Watched body;
  for (int i = 0; i < 200; ++i) body.Add(0);
  for (int i = 0; i < 10; ++i) body.Add(kFlagDegenerate);
  EXPECT_TRUE(body.MayEnterMap(kNewPart)) << "it moves on, and would be out of its map";
  EXPECT_FALSE(body.MayEnterMap(kWrongWall)) << "it has slid to where the map says otherwise";
  EXPECT_NE(body.Add(0, kNewPart), 0U) << "its poses are in doubt all the same";
  EXPECT_TRUE(body.MayEnterMap(kNewPart));

  body.Add(kFlagNoPoints);
  EXPECT_EQ(body.Add(kFlagDegenerate, kNewPart), +kFlagDegenerate);
  EXPECT_FALSE(body.MayEnterMap(kNewPart)) << "it may be anywhere since it saw nothing";
  EXPECT_EQ(body.Add(0), 0U);
  body.Add(kFlagDegenerate);
  body.Add(kFlagDegenerate);
  EXPECT_TRUE(body.MayEnterMap(kNewPart)) << "that was another doubt";
}

TEST(DoubtWatch, AJumpBeginsItAtOnce) {
  Watched body(1e-6, 1e-6);
  for (int i = 0; i < 200; ++i) body.Add(0);
  EXPECT_EQ(body.Add(kFlagJump, kWrongWall), +kFlagJump);
  EXPECT_FALSE(body.MayEnterMap(kWrongWall));
  EXPECT_TRUE(body.MayEnterMap(kNewPart));
  EXPECT_EQ(body.Add(0, kWrongWall), +kFlagJump);
  EXPECT_EQ(body.Add(0), 0U);
}

TEST(DoubtWatch, ABodyThatNeverAgreedIsMeasuredByWhatIsUsualElsewhere) {
  Watched body;
  body.Add(kFlagJump);
  EXPECT_NE(body.Add(0, kWrongWall), 0U);
  EXPECT_EQ(body.Add(0, Seen{500, 490, 100, 80, 0}), 0U);
}

TEST(DoubtWatch, ReachesAsFarAsTheMotionThatWasNotSeen) {
  Watched body(100.0, 1.0);
  for (int i = 0; i < 10; ++i) body.Add(0);
  EXPECT_FALSE(body.Reach(kWrongWall)) << "nothing is in doubt";
  for (int i = 0; i < 5; ++i) body.Add(kFlagDegenerate);
  EXPECT_FALSE(body.Reach({})) << "a direction is open, and nothing contradicts the map";
  // 3 sqrt(q t³ / 3) with t = 0.15 s, by the densities when the doubt began.
  const double root = 3.0 * std::sqrt(std::pow(0.15, 3) / 3.0);
  ASSERT_TRUE(body.Reach(kWrongWall));
  EXPECT_NEAR(body.Reach(kWrongWall)->translation_m, 10.0 * root, 1e-9);
  body.SetDensity(1e4, 1e4);
  body.Add(0, kWrongWall);
  ASSERT_TRUE(body.Reach({})) << "the points hold it again, perhaps at the wrong place";
  EXPECT_NEAR(body.Reach({})->translation_m, 10.0 * root, 1e-9);
  EXPECT_NEAR(body.Reach({})->rotation_rad, root, 1e-9);
}

TEST(DoubtWatch, ABodyThatSawOnlyAFloorMayHaveTurnedOnIt) {
  Watched body;
  const Seen only_floor{500, 490, 2, 2, 0};
  body.Add(0, only_floor);
  EXPECT_FALSE(body.open_axis()) << "nothing is in doubt";
  for (int i = 0; i < 3; ++i) body.Add(kFlagDegenerate);
  EXPECT_FALSE(body.open_axis()) << "the wall holds it";
  for (int i = 0; i < 3; ++i) body.Add(kFlagDegenerate, only_floor);
  body.Add(kFlagDegenerate);
  ASSERT_TRUE(body.open_axis()) << "it may have turned before the wall came back";
  EXPECT_NEAR(std::abs(body.open_axis()->z()), 1.0, 1e-4);
  body.Dispel();
  EXPECT_FALSE(body.open_axis());
}

TEST(DoubtWatch, IsOverWhenTheBodyWasFound) {
  Watched body = InDoubt();
  body.Dispel();
  EXPECT_TRUE(body.MayEnterMap(kNewPart));
  EXPECT_EQ(body.Add(0, kWrongWall), 0U);
  EXPECT_FALSE(body.Reach(kWrongWall));
}

TEST(DoubtWatch, WhatWasUnseenBeforeTheBodyWasFoundDoesNotCount) {
  Watched body = InDoubt();
  body.Dispel();
  EXPECT_EQ(body.Add(kFlagDegenerate), 0U) << "for one window it has not moved far";
  EXPECT_EQ(body.Add(kFlagNoPoints), +kFlagNoPoints);
}

TEST(DoubtWatch, InDoubtOnlyWhatAgreesEntersTheMap) {
  Watched body = InDoubt();
  EXPECT_TRUE(body.MayEnterMap({}));
  EXPECT_FALSE(body.MayEnterMap(kWrongWall));
  EXPECT_FALSE(body.MayEnterMap(kNewPart));
  EXPECT_TRUE(body.MayEnterMap(kPartlyNew)) << "the map may grow before the place is trusted";
  body.Add(0);
  EXPECT_TRUE(body.MayEnterMap(kWrongWall));
  EXPECT_TRUE(body.MayEnterMap(kNewPart));
}

}  // namespace
}  // namespace trajlo
