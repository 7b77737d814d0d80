// SPDX-License-Identifier: MIT
#include "core/report/processing_time.h"

#include <gtest/gtest.h>

namespace trajlo {
namespace {

constexpr std::int64_t kTenth = 100'000'000;

TEST(Quantile, InterpolatesBetweenSortedValues) {
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
  EXPECT_EQ(Quantile({7.0}, 0.95), 7.0);
  EXPECT_EQ(Quantile({3.0, 1.0, 2.0}, 0.5), 2.0);
  EXPECT_EQ(Quantile({1.0, 2.0}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(Quantile({0.0, 10.0}, 0.95), 9.5);
}

TEST(ProcessingTime, SumsOverEachSecondOfData) {
  ProcessingTime time;
  for (int i = 0; i < 30; ++i) time.Add(i * kTenth, i < 20 ? 2.0 : 5.0);
  const auto quantiles = time.PerSecondOfData(30 * kTenth);
  EXPECT_DOUBLE_EQ(quantiles.median_ms, 20.0);
  EXPECT_DOUBLE_EQ(quantiles.p95_ms, 20.0 + 0.9 * 30.0);
  EXPECT_DOUBLE_EQ(time.total_ms(), 90.0);
}

TEST(ProcessingTime, ScalesALastSecondThatIsNotFull) {
  ProcessingTime time;
  for (int i = 0; i < 16; ++i) time.Add(i * kTenth, 2.0);
  EXPECT_DOUBLE_EQ(time.PerSecondOfData(16 * kTenth).p95_ms, 20.0);
}

TEST(ProcessingTime, AShortRestCountsToTheSecondBefore) {
  ProcessingTime time;
  for (int i = 0; i < 12; ++i) time.Add(i * kTenth, 2.0);
  EXPECT_DOUBLE_EQ(time.PerSecondOfData(12 * kTenth).median_ms, 20.0);
}

TEST(ProcessingTime, NoDataAndAPauseOfYearsAreHarmless) {
  EXPECT_EQ(ProcessingTime().PerSecondOfData(0).median_ms, 0.0);
  ProcessingTime time;
  time.Add(0, 4.0);
  time.Add(std::int64_t{1} << 60, 4.0);
  EXPECT_GT(time.PerSecondOfData((std::int64_t{1} << 60) + 1).median_ms, 0.0);
  ProcessingTime backwards;
  backwards.Add(100, 4.0);
  EXPECT_EQ(backwards.PerSecondOfData(0).median_ms, 0.0);
}

}  // namespace
}  // namespace trajlo
