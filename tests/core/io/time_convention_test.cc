// SPDX-License-Identifier: MIT
#include "core/io/time_convention.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/io/errors.h"

namespace trajlo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kEpoch = 1.6e9;  // s

/// Five scans of a 10 Hz LiDAR. Scan k is measured in [0.1 k, 0.1 k + 0.0999] s after the epoch;
/// its time field runs from first_s to last_s in the given unit, both moved by k * step_s.
TimeEvidence FiveScans(double unit_per_second, double first_s, double last_s, double step_s,
                       bool stamps, ScalarType type = ScalarType::kFloat64) {
  TimeEvidence evidence;
  evidence.path = "scan.pcd";
  evidence.field = "t";
  evidence.type = type;
  evidence.period_s = stamps ? 0.1 : 0.0;
  for (int k = 0; k < 5; ++k) {
    TimeSample sample;
    sample.first = (first_s + k * step_s) * unit_per_second;
    sample.last = (last_s + k * step_s) * unit_per_second;
    if (stamps) sample.stamp_ns = std::llround(1e9 * kEpoch) + k * 100'000'000LL;
    evidence.samples.push_back(sample);
  }
  return evidence;
}

struct Unit {
  const char* name;
  double per_second;
  TimeUnit unit;
};

class EveryUnit : public testing::TestWithParam<std::tuple<Unit, bool>> {
 protected:
  double per_second() const { return std::get<0>(GetParam()).per_second; }
  TimeUnit unit() const { return std::get<0>(GetParam()).unit; }
  bool stamps() const { return std::get<1>(GetParam()); }
};

TEST_P(EveryUnit, TimesFromZeroToASweepAreRelativeToTheStart) {
  const auto found = DeduceTimeConvention(FiveScans(per_second(), 0, 0.0999, 0, stamps()), {});
  EXPECT_EQ(found.unit, unit());
  EXPECT_EQ(found.origin, TimeOrigin::kSweepStart);
  EXPECT_EQ(found.stamp_at, StampAt::kStart);
  EXPECT_EQ(found.ZeroAfterStampNs(), 0);
}

TEST_P(EveryUnit, NegativeTimesCountBackFromAStampAtTheEnd) {
  const auto found = DeduceTimeConvention(FiveScans(per_second(), -0.0999, 0, 0, stamps()), {});
  EXPECT_EQ(found.unit, unit());
  EXPECT_EQ(found.origin, TimeOrigin::kSweepEnd);
  EXPECT_EQ(found.stamp_at, StampAt::kEnd);
  EXPECT_EQ(found.ZeroAfterStampNs(), 0);
}

TEST_P(EveryUnit, TimesAroundZeroAreRelativeToAStampInsideTheSweep) {
  const auto found = DeduceTimeConvention(FiveScans(per_second(), -0.05, 0.05, 0, stamps()), {});
  EXPECT_EQ(found.unit, unit());
  EXPECT_EQ(found.origin, TimeOrigin::kStamp);
  EXPECT_EQ(found.ZeroAfterStampNs(), 0);
}

TEST_P(EveryUnit, TimesSince1970AreAbsolute) {
  const auto found =
      DeduceTimeConvention(FiveScans(per_second(), kEpoch, kEpoch + 0.0999, 0.1, stamps()), {});
  EXPECT_EQ(found.unit, unit());
  EXPECT_TRUE(found.IsAbsolute());
  EXPECT_EQ(found.clock_offset_ns, 0);
}

TEST_P(EveryUnit, AClockThatRunsOnFromTheFirstScanIsAbsolute) {
  const auto found = DeduceTimeConvention(FiveScans(per_second(), 0, 0.0999, 0.1, stamps()), {});
  EXPECT_EQ(found.unit, unit());
  EXPECT_TRUE(found.IsAbsolute());
  if (stamps()) {
    EXPECT_NEAR(static_cast<double>(found.clock_offset_ns), 1e9 * kEpoch, 1e3);
    EXPECT_THAT(found.evidence, HasSubstr("another clock"));
  }
}

INSTANTIATE_TEST_SUITE_P(Units, EveryUnit,
                         testing::Combine(testing::Values(Unit{"s", 1, TimeUnit::kSeconds},
                                                          Unit{"ms", 1e3, TimeUnit::kMilliseconds},
                                                          Unit{"us", 1e6, TimeUnit::kMicroseconds},
                                                          Unit{"ns", 1e9, TimeUnit::kNanoseconds}),
                                          testing::Bool()),
                         [](const auto& param) {
                           return std::string(std::get<0>(param.param).name) +
                                  (std::get<1>(param.param) ? "WithStamps" : "WithoutStamps");
                         });

TEST(TimeConvention, AbsoluteTimesTellWhichEndTheStampMarks) {
  const auto found = DeduceTimeConvention(FiveScans(1, kEpoch - 0.0999, kEpoch, 0.1, true), {});
  EXPECT_TRUE(found.IsAbsolute());
  EXPECT_EQ(found.stamp_at, StampAt::kEnd);
}

TEST(TimeConvention, AUnitThatTheStampsContradictIsTakenAndDoubted) {
  TimeOptions told;
  told.unit = TimeUnit::kMicroseconds;
  const auto found = DeduceTimeConvention(FiveScans(1, 0, 0.0999, 0, true), told);
  EXPECT_EQ(found.unit, TimeUnit::kMicroseconds);
  EXPECT_THAT(found.doubt, AllOf(HasSubstr("input.time_unit=us makes a sweep take 9.99e-08 s"),
                                 HasSubstr("stamps are 0.1 s apart")));
  EXPECT_EQ(DeduceTimeConvention(FiveScans(1e6, 0, 0.0999, 0, true), told).doubt, "");
  EXPECT_EQ(DeduceTimeConvention(FiveScans(1, 0, 0.0999, 0, false), told).doubt, "");
}

TEST(TimeConvention, AnAssumptionIsNoEvidence) {
  EXPECT_TRUE(DeduceTimeConvention(FiveScans(1, 0, 0.0999, 0, true), {}).stamp_at_is_assumed);
  TimeEvidence recorded = FiveScans(1, 0, 0.0999, 0, true);
  for (TimeSample& sample : recorded.samples) sample.recorded_ns = *sample.stamp_ns + 5'000'000;
  EXPECT_FALSE(DeduceTimeConvention(recorded, {}).stamp_at_is_assumed);
  TimeOptions told;
  told.stamp_at = StampAt::kStart;
  EXPECT_FALSE(DeduceTimeConvention(FiveScans(1, 0, 0.0999, 0, true), told).stamp_at_is_assumed);
}

TEST(TimeConvention, GapsInTheStampsDoNotHideTheUnit) {
  TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
  evidence.period_s = 0.4;
  const auto found = DeduceTimeConvention(evidence, {});
  EXPECT_EQ(found.unit, TimeUnit::kSeconds);
  EXPECT_EQ(found.sweep_ns, 99'900'000);
}

TEST(TimeConvention, ASweepOfWhichOnlyTheLastPartReturnsIsRelativeAllTheSame) {
  const auto found = DeduceTimeConvention(FiveScans(1e9, 0.0503, 0.0996, 0, true), {});
  EXPECT_EQ(found.unit, TimeUnit::kNanoseconds);
  EXPECT_EQ(found.origin, TimeOrigin::kSweepStart);
}

TEST(TimeConvention, ThePeriodIsTheSweepWhenBothAgree) {
  EXPECT_EQ(DeduceTimeConvention(FiveScans(1, 0, 0.0999, 0, true), {}).sweep_ns, 100'000'000);
}

TEST(TimeConvention, APartialFirstScanDoesNotMislead) {
  TimeEvidence evidence = FiveScans(1e9, 0, 0.0999, 0, true);
  evidence.samples[0].last = 2e6;
  EXPECT_EQ(DeduceTimeConvention(evidence, {}).unit, TimeUnit::kNanoseconds);
}

TEST(TimeConvention, OneBrokenScanOfSeveralDoesNotMislead) {
  for (const double broken : {1e12, -77.0, 3.4e38, 0.3, -1e30}) {
    for (std::size_t k = 0; k < 5; ++k) {
      for (const bool is_first : {true, false}) {
        TimeEvidence relative = FiveScans(1, 0, 0.0999, 0, true, ScalarType::kFloat32);
        (is_first ? relative.samples[k].first : relative.samples[k].last) = broken;
        const auto found = DeduceTimeConvention(relative, {});
        EXPECT_EQ(found.unit, TimeUnit::kSeconds) << broken;
        EXPECT_EQ(found.origin, TimeOrigin::kSweepStart) << broken;
        EXPECT_EQ(found.sweep_ns, 100'000'000) << broken;
        TimeEvidence absolute = FiveScans(1, kEpoch, kEpoch + 0.0999, 0.1, true);
        (is_first ? absolute.samples[k].first : absolute.samples[k].last) = broken;
        EXPECT_TRUE(DeduceTimeConvention(absolute, {}).IsAbsolute()) << broken;
      }
    }
  }
}

TEST(TimeConvention, OneWrongStampDoesNotHideTheClock) {
  for (std::size_t k = 0; k < 5; ++k) {
    for (const std::int64_t wrong_ns : {432'000'000'000'000, -432'000'000'000'000}) {
      TimeEvidence evidence = FiveScans(1, 7.0, 7.0999, 0.1, true);
      *evidence.samples[k].stamp_ns += wrong_ns;
      const auto found = DeduceTimeConvention(evidence, {});
      EXPECT_TRUE(found.IsAbsolute());
      EXPECT_NEAR(static_cast<double>(found.clock_offset_ns), 1e9 * (kEpoch - 7.0), 1e3);
    }
  }
}

/// Scans at 10 Hz whose sweep `cut` is only 40 ms long, recorded `delay_s` after their stamps.
TimeEvidence WithACutSweep(std::size_t cut, bool at_end, std::optional<double> delay_s) {
  TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
  std::int64_t begin_ns = std::llround(1e9 * kEpoch);
  for (std::size_t k = 0; k < 5; ++k) {
    TimeSample& sample = evidence.samples[k];
    const std::int64_t length_ns = k == cut ? 40'000'000 : 100'000'000;
    if (k == cut) sample.last = 0.0399;
    sample.stamp_ns = begin_ns + (at_end ? length_ns : 0);
    if (delay_s) sample.recorded_ns = *sample.stamp_ns + std::llround(1e9 * *delay_s);
    begin_ns += length_ns;
  }
  return evidence;
}

TEST(TimeConvention, ASweepThatIsCutShortTellsWhichEndStampsMark) {
  // Whatever the times of recording pretend.
  for (const std::optional<double> delay_s : {std::optional<double>(), {0.0}, {0.05}, {0.15}}) {
    for (std::size_t cut = 1; cut < 4; ++cut) {
      for (const bool at_end : {false, true}) {
        const auto found = DeduceTimeConvention(WithACutSweep(cut, at_end, delay_s), {});
        EXPECT_EQ(found.stamp_at, at_end ? StampAt::kEnd : StampAt::kStart) << cut;
        EXPECT_EQ(found.doubt, "");
        EXPECT_THAT(found.evidence, HasSubstr("cut short"));
      }
    }
  }
}

TEST(TimeConvention, AScanThatMissesItsLastPointsIsNoSweepThatIsCutShort) {
  for (std::size_t k = 0; k < 5; ++k) {
    TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
    evidence.samples[k].last = 0.06;
    const auto found = DeduceTimeConvention(evidence, {});
    EXPECT_THAT(found.evidence, AllOf(HasSubstr("assumed"), Not(HasSubstr("cut short"))));
  }
}

TEST(TimeConvention, TimesOfRecordingThatCopyTheStampsProveNothing) {
  for (const std::int64_t rounding_ns : {0, 240, -240}) {
    TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
    for (TimeSample& sample : evidence.samples) {
      sample.recorded_ns = *sample.stamp_ns + rounding_ns;
    }
    const auto found = DeduceTimeConvention(evidence, {});
    EXPECT_EQ(found.stamp_at, StampAt::kStart);
    EXPECT_THAT(found.doubt, AllOf(HasSubstr("copies"), HasSubstr("0.1 s too late"),
                                   HasSubstr("input.stamp_at=end")));
    TimeOptions told;
    told.stamp_at = StampAt::kEnd;
    EXPECT_EQ(DeduceTimeConvention(evidence, told).doubt, "");
  }
}

TEST(TimeConvention, ARecorderWithAnotherClockLeavesADoubt) {
  for (const std::int64_t delay_ns : {-3'000'000'000, 86'400'000'000'000}) {
    TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
    for (TimeSample& sample : evidence.samples) sample.recorded_ns = *sample.stamp_ns + delay_ns;
    const auto found = DeduceTimeConvention(evidence, {});
    EXPECT_EQ(found.stamp_at, StampAt::kStart);
    EXPECT_THAT(found.doubt, HasSubstr("input.stamp_at"));
    const bool is_behind = delay_ns < 0;
    EXPECT_THAT(found.doubt, HasSubstr(is_behind ? "it is 3 s behind" : "it is 8.64e+04 s ahead"));
    EXPECT_THAT(found.evidence, HasSubstr(is_behind ? "recorded 3 s before their stamp"
                                                    : "recorded 8.64e+04 s after their stamp"));
  }
}

TEST(TimeConvention, StampsThatDoNotMoveTellNoDelay) {
  TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
  for (TimeSample& sample : evidence.samples) {
    sample.recorded_ns = *sample.stamp_ns + 2'000'000;
    sample.stamp_ns = evidence.samples.front().stamp_ns;
  }
  const auto found = DeduceTimeConvention(evidence, {});
  EXPECT_EQ(found.stamp_at, StampAt::kStart);
  EXPECT_THAT(found.evidence,
              AllOf(HasSubstr("the stamps do not move"), Not(HasSubstr("recorded"))));
}

TEST(TimeConvention, AbsoluteTimesThatLieSweepsBeforeTheStampsLeaveADoubt) {
  const auto before = [](double by_s) {
    return DeduceTimeConvention(FiveScans(1, kEpoch - by_s, kEpoch - by_s + 0.0999, 0.1, true), {});
  };
  EXPECT_EQ(before(0.15).doubt, "");
  EXPECT_THAT(before(0.15).evidence,
              HasSubstr("the stamp lies 0.15 s after the first point and 0.0501 s after the last"));
  EXPECT_THAT(before(1.0).doubt,
              AllOf(HasSubstr("1 s after the first point"), HasSubstr("input.clock_offset_s")));
}

TEST(TimeConvention, StampsTooFarApartForALidarMayBeInAnotherUnit) {
  for (const auto& [period_s, unit] : {std::pair(100.0, "in ms"), std::pair(1e5, "in us")}) {
    TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
    evidence.period_s = period_s;
    try {
      DeduceTimeConvention(evidence, {});
      FAIL() << "a sweep a thousand times shorter than the step of the stamps";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(unit), HasSubstr("Write the stamps in s")));
    }
  }
}

TEST(TimeConvention, ADelayThatIsRealLeavesNoDoubt) {
  for (const double delay_s : {0.0002, 0.002, 0.03, 0.1, 0.13}) {
    TimeEvidence evidence = FiveScans(1, 0, 0.0999, 0, true);
    for (TimeSample& sample : evidence.samples) {
      sample.recorded_ns = *sample.stamp_ns + std::llround(1e9 * delay_s);
    }
    const auto found = DeduceTimeConvention(evidence, {});
    EXPECT_EQ(found.stamp_at, delay_s < 0.08 ? StampAt::kEnd : StampAt::kStart);
    EXPECT_EQ(found.doubt, "");
  }
}

TEST(TimeConvention, ASpanThatIsASweepInNoUnitIsAnErrorThatShowsTheEvidence) {
  try {
    DeduceTimeConvention(FiveScans(1, 0, 2, 0, true), {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("ambiguous"), HasSubstr("from 0 to 2"), HasSubstr("0.1 s apart"),
                      HasSubstr("2 s if in s, 0.002 s if in ms"), HasSubstr("time_unit")));
  }
}

TEST(TimeConvention, TimesThatAreNeitherRelativeNorAClockAreAnError) {
  // Always 5.0 to 5.1: zero is far outside the sweep, and the clock does not run.
  EXPECT_THROW(DeduceTimeConvention(FiveScans(1, 5.0, 5.0999, 0, true), {}), InputError);
  // A clock that runs ten times too fast.
  EXPECT_THROW(DeduceTimeConvention(FiveScans(1, 5.0, 5.0999, 1.0, true), {}), InputError);
}

TEST(TimeConvention, AbsoluteSecondsInFloat32AreRefusedBecauseTheyAreLost) {
  TimeEvidence evidence = FiveScans(1, kEpoch, kEpoch, 0, true, ScalarType::kFloat32);
  for (const double span : {0.0, 128.0}) {
    for (TimeSample& sample : evidence.samples) sample.last = sample.first + span;
    try {
      DeduceTimeConvention(evidence, {});
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("float32 of that size cannot tell"));
    }
  }
}

TEST(TimeConvention, RelativeNanosecondsInFloat32AreFine) {
  const auto found =
      DeduceTimeConvention(FiveScans(1e9, 0, 0.0999, 0, true, ScalarType::kFloat32), {});
  EXPECT_EQ(found.unit, TimeUnit::kNanoseconds);
}

TEST(TimeConvention, AFieldThatIsTheSameForAllPointsMeansNoPointTimes) {
  const auto found = DeduceTimeConvention(FiveScans(1, 0, 0, 0, true), {});
  EXPECT_FALSE(found.HasPointTimes());
  EXPECT_THAT(found.evidence, HasSubstr("no point times"));
}

TEST(TimeConvention, EveryPartCanBeOverridden) {
  TimeOptions options;
  options.unit = TimeUnit::kMilliseconds;
  options.origin = TimeOrigin::kSweepStart;
  options.stamp_at = StampAt::kEnd;
  const auto found = DeduceTimeConvention(FiveScans(1, 0, 30, 0, true), options);
  EXPECT_EQ(found.unit, TimeUnit::kMilliseconds);
  EXPECT_EQ(found.ZeroAfterStampNs(), -30'000'000);
}

TEST(TimeConvention, AStampAtTheEndMovesTimesBackByASweep) {
  TimeOptions options;
  options.stamp_at = StampAt::kEnd;
  const auto found = DeduceTimeConvention(FiveScans(1e9, 0, 0.0999, 0, true), options);
  EXPECT_EQ(found.origin, TimeOrigin::kSweepStart);
  EXPECT_EQ(found.ZeroAfterStampNs(), -100'000'000);
}

TEST(TimeConvention, ANegativeTimeWithAStampAtTheStartIsMovedForward) {
  TimeOptions options;
  options.stamp_at = StampAt::kStart;
  const auto found = DeduceTimeConvention(FiveScans(1e9, -0.0999, 0, 0, true), options);
  EXPECT_EQ(found.ZeroAfterStampNs(), 100'000'000);
}

}  // namespace
}  // namespace trajlo
