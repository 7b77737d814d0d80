// SPDX-License-Identifier: MIT
#include "core/odometry/start/return_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace trajlo {
namespace {

constexpr std::int64_t kSegment_ns = 30'000'000;
constexpr double kSegment_s = 0.03;

SegmentCloud Segment(std::int64_t begin_ns, bool has_points = true) {
  SegmentCloud segment;
  segment.begin_ns = begin_ns;
  segment.end_ns = begin_ns + kSegment_ns;
  if (has_points) {
    segment.map_points.push_back({Eigen::Vector3f(1, 2, 3), 0.5F});
    segment.registration_points = segment.map_points;
  }
  return segment;
}

SegmentCloud Gap(std::int64_t begin_ns) {
  SegmentCloud gap = Segment(begin_ns, false);
  gap.is_gap = true;
  return gap;
}

class Searching {
 public:
  explicit Searching(double density_m2_s3 = 0.5) : search_(Last(density_m2_s3), options_) {}

  void Add(int segments) {
    for (int i = 0; i < segments; ++i) {
      search_.Add(Segment(t_ns_));
      t_ns_ += kSegment_ns;
    }
  }
  ReturnSearch& search() { return search_; }
  std::int64_t t_ns() const { return t_ns_; }
  /// How many segments must come until a look is due.
  int UntilDue() {
    int segments = 0;
    for (; !search_.IsDue() && segments < 1000; ++segments) Add(1);
    return segments;
  }

 private:
  static LastSeen Last(double density_m2_s3) {
    LastSeen last;
    last.density.setConstant(density_m2_s3);
    last.velocity << 2, 0, 0, 0, 0, 0.5;
    return last;
  }

  OdometryOptions options_;
  ReturnSearch search_;
  std::int64_t t_ns_ = 0;
};

TEST(ReturnSearch, LooksWhenASweepOfAFirstIntervalHasCome) {
  Searching calm;
  EXPECT_FALSE(calm.search().HasPoints());
  EXPECT_EQ(calm.UntilDue(), 9);  // 0.27 s: another segment would be more than 0.3 s.
  calm.Add(100);
  EXPECT_EQ(calm.search().TakeSegments().size(), 10U) << "the newest 0.3 s are kept";
}

TEST(ReturnSearch, ASweepIsShortWhereTheMotionMayBend) {
  // (90 x 0.06² / 100)^(1/3) = 0.148 s: four segments, and a fifth would be too many.
  EXPECT_EQ(Searching(100.0).UntilDue(), 4);
  EXPECT_EQ(Searching(1e9).UntilDue(), 2) << "never fewer than three segments, less one";
}

TEST(ReturnSearch, WhatCameBeforeAGapIsOfNoUse) {
  Searching body;
  body.Add(5);
  body.search().Add(Gap(body.t_ns()));
  EXPECT_FALSE(body.search().HasPoints());
  EXPECT_FALSE(body.search().IsDue());
}

TEST(ReturnSearch, BeginsWithASegmentThatHasPoints) {
  Searching body;
  body.search().Add(Segment(0, false));
  EXPECT_FALSE(body.search().HasPoints());
}

TEST(ReturnSearch, IsHopelessAfterItsTimeWithPoints) {
  Searching body;
  for (int i = 0; i < 1000; ++i) body.search().Add(Segment(i * kSegment_ns, false));
  EXPECT_FALSE(body.search().IsHopeless()) << "there was nothing to look for";
  body.Add(static_cast<int>(ReturnSearch::kMaxSearch_s / 0.03) - 1);
  EXPECT_FALSE(body.search().IsHopeless());
  body.Add(3);
  EXPECT_TRUE(body.search().IsHopeless());
}

TEST(ReturnSearch, GoesOnAsTheBodyDidButNotForEver) {
  Searching body;
  const SE3 after_1_s = body.search().Predict(1'000'000'000);
  EXPECT_NEAR(so3::Log(after_1_s.q).norm(), 0.5, 1e-9);
  EXPECT_NEAR(after_1_s.t.norm(), 2.0, 0.05);
  const SE3 after_5_s = body.search().Predict(5'000'000'000);
  EXPECT_LT(Minus(body.search().Predict(60'000'000'000), after_5_s).norm(), 1e-9);
}

}  // namespace
}  // namespace trajlo
