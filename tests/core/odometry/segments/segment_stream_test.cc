// SPDX-License-Identifier: MIT
#include "core/odometry/segments/segment_stream.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace trajlo {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr int kScans = 20;

/// Of 100 ms, a point each; no two scans are alike.
LidarScan MakeScan(int number) {
  LidarScan scan;
  scan.stamp_ns = 100 * number * kMs;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(5 + (7 * number + i) % 100);
    scan.points.push_back({{x, static_cast<float>(number), 1.0F}, 0.0F, scan.stamp_ns + i * kMs});
  }
  return scan;
}

SegmenterOptions Options() {
  SegmenterOptions options;
  options.interval_s = 0.03;
  return options;
}

class EveryStream : public ::testing::TestWithParam<int> {
 protected:
  ThreadPool threads_{GetParam()};
  std::vector<SegmentCloud> segments_;
  std::vector<std::int64_t> noticed_ns_;  ///< The stamps.
  int bad_segment_ = -1;
  SegmentStream stream_{Options(), &threads_, [this](SegmentCloud segment) {
                          segments_.push_back(std::move(segment));
                          const int index = static_cast<int>(segments_.size()) - 1;
                          if (index == bad_segment_) throw std::runtime_error("bad segment");
                        }};

  void NoticeScans() {
    stream_.OnScan([this](const LidarScan& scan) { noticed_ns_.push_back(scan.stamp_ns); });
  }
  void ExpectAllSegments() const {
    Segmenter segmenter(Options());
    for (int i = 0; i < kScans; ++i) segmenter.AddScan(MakeScan(i));
    segmenter.Finish();
    for (const SegmentCloud& segment : segments_) {
      const auto expected = segmenter.Next();
      ASSERT_TRUE(expected);
      EXPECT_EQ(segment.begin_ns, expected->begin_ns);
      EXPECT_EQ(segment.end_ns, expected->end_ns);
      ASSERT_EQ(segment.map_points.size(), expected->map_points.size());
      for (std::size_t i = 0; i < segment.map_points.size(); ++i) {
        EXPECT_EQ(segment.map_points[i].p_body_m, expected->map_points[i].p_body_m);
      }
      EXPECT_EQ(segment.registration_points.size(), expected->registration_points.size());
    }
    EXPECT_FALSE(segmenter.Next()) << "not all were handed on";
  }
};

TEST_P(EveryStream, HandsOnTheSegmentsOfTheSegmenterAndTellsOfEveryScan) {
  NoticeScans();
  for (int i = 0; i < kScans; ++i) stream_.Add(MakeScan(i));
  stream_.Finish();
  ExpectAllSegments();
  ASSERT_EQ(noticed_ns_.size(), std::size_t{kScans});
  for (int i = 0; i < kScans; ++i)
    EXPECT_EQ(noticed_ns_[static_cast<std::size_t>(i)], 100 * i * kMs);
  EXPECT_EQ(stream_.point_counts().received, 100 * kScans);
  EXPECT_EQ(stream_.time_report().scans, kScans);
}

TEST_P(EveryStream, NoSegmentWaitsForALaterScan) {
  for (int i = 0; i < kScans; ++i) {
    stream_.Add(MakeScan(i));
    if (i < 10) continue;  // The first scans are held together.
    ASSERT_FALSE(segments_.empty());
    EXPECT_GT(segments_.back().end_ns, (100 * i + 99 - 30) * kMs);
  }
}

TEST_P(EveryStream, WhatTheReceiverThrowsReachesTheCallerAndNoSegmentIsSkipped) {
  NoticeScans();
  bad_segment_ = 40;
  int failures = 0;
  for (int i = 0; i < kScans; ++i) {
    try {
      stream_.Add(MakeScan(i));
    } catch (const std::runtime_error&) {
      ++failures;
      EXPECT_EQ(segments_.size(), 41u);
    }
  }
  stream_.Finish();
  EXPECT_EQ(failures, 1);
  ExpectAllSegments();
  EXPECT_EQ(noticed_ns_.size(), std::size_t{kScans});
}

TEST_P(EveryStream, WhatTheNoticeOfAScanThrowsReachesTheCaller) {
  stream_.OnScan([](const LidarScan& scan) {
    if (scan.stamp_ns == 1000 * kMs) throw std::runtime_error("bad scan");
  });
  for (int i = 0; i < 10; ++i) stream_.Add(MakeScan(i));
  EXPECT_THROW(stream_.Add(MakeScan(10)), std::runtime_error);
}

INSTANTIATE_TEST_SUITE_P(Threads, EveryStream, ::testing::Values(1, 2, 4));

}  // namespace
}  // namespace trajlo
