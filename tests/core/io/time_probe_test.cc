// SPDX-License-Identifier: MIT
#include "core/io/time_probe.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstring>

#include "core/io/errors.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::int64_t kPeriod = 100'000'000;

/// `count` points at 10 m with a field of times; the times run from zero to a sweep of 0.1 s.
PointTable Table(int count, const char* time_name = "time") {
  std::vector<std::array<float, 4>> rows;
  for (int i = 0; i < count; ++i) {
    rows.push_back({10.0F, 0.0F, 0.0F,
                    0.0999F * static_cast<float>(i) / static_cast<float>(std::max(count - 1, 1))});
  }
  PointTable table;
  table.count = rows.size();
  table.bytes = FileBytes(rows.size() * sizeof(rows[0]));
  if (count > 0) std::memcpy(table.bytes.data(), rows.data(), table.bytes.size());
  std::size_t offset = 0;
  for (const char* name : {"x", "y", "z", time_name}) {
    table.columns.push_back({name, ScalarType::kFloat32, offset, sizeof(rows[0]), false});
    offset += sizeof(float);
  }
  return table;
}

void SetAll(const char* column, float value, PointTable* table) {
  const std::size_t offset = table->Find(column)->offset;
  for (std::size_t i = 0; i < table->count; ++i) {
    std::memcpy(table->bytes.data() + i * 16 + offset, &value, sizeof(value));
  }
}

/// Shows the probe scans with these tables until it has enough.
std::size_t Show(const std::vector<PointTable>& tables, TimeProbe* probe) {
  std::size_t shown = 0;
  for (; shown < tables.size() && !probe->IsComplete(); ++shown) {
    const auto stamp_ns = static_cast<std::int64_t>(shown + 1) * kPeriod;
    probe->Note("scan.pcd", tables[shown], stamp_ns, std::nullopt);
  }
  return shown;
}

std::vector<PointTable> Repeated(int count, const std::function<PointTable()>& make) {
  std::vector<PointTable> tables;
  for (int i = 0; i < count; ++i) tables.push_back(make());
  return tables;
}

std::vector<PointTable> Joined(std::vector<PointTable> a, std::vector<PointTable> b) {
  for (PointTable& table : b) a.push_back(std::move(table));
  return a;
}

PointTable WithoutPositions(float value) {
  PointTable table = Table(100);
  for (const char* axis : {"x", "y", "z"}) SetAll(axis, value, &table);
  return table;
}

TEST(TimeProbe, LeadingScansThatTellNothingAreNoEvidence) {
  const std::vector<std::function<PointTable()>> kinds = {
      [] { return Table(0); },
      [] { return Table(1); },
      [] { return Table(3); },
      [] { return WithoutPositions(std::nanf("")); },
      [] { return WithoutPositions(0.0F); },
      [] {
        PointTable table = Table(100);
        SetAll("time", std::nanf(""), &table);
        return table;
      },
  };
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (const int leading : {1, 5, 60}) {
      TimeProbe probe("folder", {});
      const auto tables =
          Joined(Repeated(leading, kinds[kind]), Repeated(9, [] { return Table(100); }));
      EXPECT_EQ(Show(tables, &probe), static_cast<std::size_t>(leading + 5)) << kind;
      const TimeConvention found = probe.Decide();
      EXPECT_EQ(found.field, "time") << kind;
      EXPECT_EQ(found.origin, TimeOrigin::kSweepStart) << kind;
      EXPECT_EQ(found.sweep_ns, kPeriod) << kind;
    }
  }
}

TEST(TimeProbe, ScansOfAFewPointsAreAskedWhereThereAreNoOthers) {
  TimeProbe probe("folder", {});
  Show(Repeated(20, [] { return Table(5); }), &probe);
  EXPECT_EQ(probe.Decide().field, "time");
}

TEST(TimeProbe, DoesNotAskForEver) {
  TimeProbe empty("folder", {});
  EXPECT_EQ(Show(Repeated(600, [] { return Table(0); }), &empty), TimeProbe::kMostScans);
  EXPECT_THAT(empty.Decide().evidence, HasSubstr("none of the first 500 scans has enough points"));
  TimeProbe constant("folder", {});
  const auto tables = Repeated(100, [] {
    PointTable table = Table(100);
    SetAll("time", 0.0F, &table);
    return table;
  });
  EXPECT_EQ(Show(tables, &constant), 20U);
  EXPECT_THAT(constant.Decide().evidence, HasSubstr("'time' is the same for all points"));
  TimeProbe unnamed("folder", {});
  EXPECT_EQ(Show(Repeated(100, [] { return Table(100, "curvature"); }), &unnamed), 5U);
  EXPECT_THAT(unnamed.Decide().evidence,
              HasSubstr("none of the fields (x y z curvature) has a known name"));
}

/// A field of times that are all `value`, and behind it a second field.
PointTable WithSecondField(float value, const char* second) {
  PointTable table = Table(100, second);
  Column first = *table.Find(second);
  first.name = "t";
  first.offset = 4;  // That of y, which is zero in all points.
  SetAll("y", value, &table);
  table.columns.push_back(first);
  return table;
}

TEST(TimeProbe, AConstantFieldHidesNoOther) {
  TimeProbe probe("folder", {});
  EXPECT_EQ(Show(Repeated(9, [] { return WithSecondField(0.0F, "timestamp"); }), &probe), 5U);
  const TimeConvention found = probe.Decide();
  EXPECT_EQ(found.field, "timestamp");
  EXPECT_EQ(found.sweep_ns, kPeriod);
  EXPECT_THAT(found.evidence, HasSubstr("field 't' is the same for all points of a scan; field "
                                        "'timestamp'"));
}

TEST(TimeProbe, BehindAConstantFieldWhatIsNotUnderstoodIsTold) {
  TimeProbe probe("folder", {});
  Show(Repeated(9,
                [] {
                  PointTable table = WithSecondField(0.0F, "stamp");
                  for (std::size_t i = 0; i < table.count; ++i) {
                    const auto far = static_cast<float>(10'000'000 * i);
                    std::memcpy(table.bytes.data() + i * 16 + 12, &far, sizeof(far));
                  }
                  return table;
                }),
       &probe);
  const TimeConvention found = probe.Decide();
  EXPECT_FALSE(found.HasPointTimes());
  EXPECT_THAT(found.doubt, HasSubstr("what field 'stamp' holds is not known"));
}

TEST(TimeProbe, FieldsThatNothingIsKnownAboutAreNamed) {
  TimeProbe unknown("folder", {});
  Show(Repeated(9, [] { return Table(100, "curvature"); }), &unknown);
  EXPECT_THAT(unknown.Decide().doubt,
              HasSubstr("if one of the fields curvature has the times, name it with "
                        "input.time_field"));
  TimeProbe none("folder", {});
  Show(Repeated(9, [] { return Table(100, "ring"); }), &none);
  EXPECT_THAT(none.Decide().doubt, ::testing::Not(HasSubstr("input.time_field")));
  for (const char* name : {"timeoffset", "point_time_offset"}) {
    TimeProbe known("folder", {});
    Show(Repeated(9, [&] { return Table(100, name); }), &known);
    EXPECT_EQ(known.Decide().field, name);
  }
}

TEST(TimeProbe, WhatIsAskedForIsObeyedOrRefused) {
  TimeOptions options;
  options.field = "time";
  TimeProbe obeyed("folder", options);
  Show(Joined(Repeated(5, [] { return Table(0); }), Repeated(5, [] { return Table(100); })),
       &obeyed);
  EXPECT_EQ(obeyed.Decide().field, "time");

  const auto refusal = [](const TimeOptions& asked, const std::vector<PointTable>& tables) {
    try {
      TimeProbe probe("folder", asked);
      Show(tables, &probe);
      probe.Decide();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(refusal(options, Repeated(30, [] { return Table(0); })),
              AllOf(HasSubstr("point times are asked for"), HasSubstr("enough points")));
  EXPECT_THAT(refusal(options, Repeated(5, [] { return Table(100, "t"); })),
              HasSubstr("'time' (input.time_field); the points have: x y z t"));
  TimeOptions unit;
  unit.unit = TimeUnit::kMilliseconds;
  EXPECT_THAT(refusal(unit, Repeated(5, [] { return Table(100, "curvature"); })),
              HasSubstr("has a known name"));
}

}  // namespace
}  // namespace trajlo
