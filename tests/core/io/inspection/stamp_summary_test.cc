// SPDX-License-Identifier: MIT
#include "core/io/inspection/stamp_summary.h"

#include <gmock/gmock.h>

#include <cmath>

namespace trajlo {
namespace {

using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

std::vector<std::int64_t> Every100Ms(int count) {
  std::vector<std::int64_t> t_ns;
  for (int i = 0; i < count; ++i) t_ns.push_back(1'000'000 * kMs + i * 100 * kMs);
  return t_ns;
}

TEST(StampSummary, RegularStampsHaveNothingToReport) {
  const StampSummary stamps = SummariseStamps(Every100Ms(20), {});
  EXPECT_EQ(stamps.count, 20u);
  EXPECT_DOUBLE_EQ(stamps.period_s, 0.1);
  EXPECT_LT(stamps.jitter_s, 1e-9);
  EXPECT_THAT(stamps.gaps, IsEmpty());
  EXPECT_EQ(stamps.duplicates + stamps.steps_back + stamps.missing, 0u);
  EXPECT_FALSE(stamps.recorded_after_s);
}

TEST(StampSummary, GapsSayWhereHowLongAndHowManyScansAreMissing) {
  std::vector<std::int64_t> t_ns = Every100Ms(20);
  t_ns.erase(t_ns.begin() + 5, t_ns.begin() + 8);
  const StampSummary stamps = SummariseStamps(t_ns, {});
  ASSERT_EQ(stamps.gaps.size(), 1u);
  EXPECT_EQ(stamps.gaps[0].after_ns, 1'000'400 * kMs);
  EXPECT_EQ(stamps.gaps[0].length_ns, 400 * kMs);
  EXPECT_EQ(stamps.missing, 3u);
}

TEST(StampSummary, RepeatedStampsAndStepsBackAreToldApart) {
  std::vector<std::int64_t> t_ns = Every100Ms(20);
  t_ns[7] = t_ns[6];
  t_ns[12] = t_ns[11] - 20 * kMs;
  const StampSummary stamps = SummariseStamps(t_ns, {});
  EXPECT_EQ(stamps.duplicates, 1u);
  EXPECT_EQ(stamps.first_duplicate_ns, t_ns[7]);
  EXPECT_EQ(stamps.steps_back, 1u);
  EXPECT_EQ(stamps.first_step_back_ns, t_ns[12]);
  EXPECT_NEAR(stamps.largest_step_back_s, 0.02, 1e-12);
}

TEST(StampSummary, JitterIsTheRootMeanSquareOfOrdinarySteps) {
  std::vector<std::int64_t> t_ns = Every100Ms(21);
  // Steps of 100, 101, 99, 100, ...: two of five are off by 1 ms.
  for (std::size_t i = 2; i < t_ns.size(); i += 5) t_ns[i] += kMs;
  const StampSummary stamps = SummariseStamps(t_ns, {});
  EXPECT_NEAR(stamps.jitter_s, 1e-3 * std::sqrt(0.4), 1e-9);
  EXPECT_NEAR(stamps.largest_deviation_s, 1e-3, 1e-9);
}

TEST(StampSummary, TheDelayOfTheRecorderIsGivenWithItsExtremes) {
  const std::vector<std::int64_t> t_ns = Every100Ms(3);
  const StampSummary stamps =
      SummariseStamps(t_ns, {t_ns[0] + 5 * kMs, t_ns[1] + 1 * kMs, t_ns[2] + 9 * kMs});
  ASSERT_TRUE(stamps.recorded_after_s);
  EXPECT_NEAR(stamps.recorded_after_s->least, 0.001, 1e-12);
  EXPECT_NEAR(stamps.recorded_after_s->median, 0.005, 1e-12);
  EXPECT_NEAR(stamps.recorded_after_s->most, 0.009, 1e-12);
}

}  // namespace
}  // namespace trajlo
