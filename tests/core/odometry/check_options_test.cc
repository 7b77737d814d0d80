// SPDX-License-Identifier: MIT
#include "core/odometry/check_options.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "core/odometry/odometry.h"

namespace trajlo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// What the constructor says; empty if it takes the options.
std::string Refusal(const OdometryOptions& options) {
  try {
    const Odometry odometry(options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string Refusal(const std::function<void(OdometryOptions*)>& change) {
  OdometryOptions options;
  change(&options);
  return Refusal(options);
}

/// Spoils one number after another, and looks whether each is refused by its name.
class Spoiler {
 public:
  explicit Spoiler(OdometryOptions* options) : options_(options) {}

  Spoiler& In(const std::string& section) {
    section_ = section;
    return *this;
  }
  template <typename... Rest>
  void operator()(OptionFor, const char*, Rest&&...) {}
  void operator()(OptionFor audience, const char* name, double& value, Range<double> range,
                  const char*) {
    Spoil(audience, name, &value,
          {kNan, std::nextafter(range.min, -1e9), std::nextafter(range.max, 1e9), -kInfinity});
  }
  void operator()(OptionFor audience, const char* name, int& value, Range<int> range, const char*) {
    Spoil(audience, name, &value, {range.min - 1, range.max + 1});
  }

  int spoilt = 0;

 private:
  template <typename Number>
  void Spoil(OptionFor audience, const char* name, Number* value,
             std::initializer_list<Number> wrong) {
    const Number right = *value;
    for (const Number number : wrong) {
      *value = number;
      EXPECT_THAT(Refusal(*options_),
                  StartsWith("'" + OptionKey(audience, section_, name) + "' must be a "));
    }
    *value = right;
    ++spoilt;
  }

  OdometryOptions* options_;
  std::string section_;
};

TEST(CheckOptions, TakesTheDefaults) { EXPECT_EQ(Refusal(OdometryOptions()), ""); }

TEST(CheckOptions, RefusesEveryNumberThatIsOutOfItsRange) {
  OdometryOptions options;
  Spoiler spoiler(&options);
  options.DescribeAll(spoiler);
  EXPECT_GE(spoiler.spoilt, 25);
}

TEST(CheckOptions, SaysWhatIsAllowedAndWhatIsThere) {
  EXPECT_EQ(Refusal([](OdometryOptions* o) { o->segmenter.interval_s = kNan; }),
            "'segmenter.interval_s' must be a number from 0.001 to 10.0, found nan");
  EXPECT_EQ(Refusal([](OdometryOptions* o) { o->window.segments = 0; }),
            "'window.segments' must be a whole number from 1 to 100, found 0");
}

TEST(CheckOptions, NamesBothOfTwoThatContradictEachOther) {
  EXPECT_THAT(Refusal([](OdometryOptions* o) {
                o->segmenter.min_range_m = 5.0;
                o->segmenter.max_range_m = 4.0;
              }),
              AllOf(HasSubstr("sensor.min_range_m (5.0)"), HasSubstr("sensor.max_range_m (4.0)")));
  EXPECT_THAT(Refusal([](OdometryOptions* o) { o->segmenter.max_gap_s = 0.02; }),
              AllOf(HasSubstr("segmenter.interval_s (0.03)"), HasSubstr("max_gap_s (0.02)")));
  EXPECT_THAT(Refusal([](OdometryOptions* o) { o->map.finest.min_point_spacing_m = 0.3; }),
              HasSubstr("expert.map.min_point_spacing_m (0.3)"));
}

TEST(CheckOptions, RefusesPosesOfLidarsThatAreNone) {
  EXPECT_THAT(Refusal([](OdometryOptions* o) {
                o->segmenter.T_body_lidar.resize(2);
                o->segmenter.T_body_lidar[1].t.x() = kNan;
              }),
              AllOf(StartsWith("'sensor.T_body_lidar'"), HasSubstr("LiDAR 1")));
  EXPECT_THAT(Refusal([](OdometryOptions* o) {
                o->segmenter.T_body_lidar.resize(1);
                o->segmenter.T_body_lidar[0].q.coeffs() *= 2.0;
              }),
              HasSubstr("LiDAR 0 has the norm 2.0"));
  EXPECT_EQ(Refusal([](OdometryOptions* o) {
              o->segmenter.T_body_lidar.resize(1);
              o->segmenter.T_body_lidar[0].q =
                  Eigen::Quaternionf(0.5F, 0.1F, 0.2F, 0.3F).normalized().cast<double>();
            }),
            "");
}

TEST(CheckOptions, RefusesAChoiceThatThereIsNot) {
  EXPECT_EQ(Refusal([](OdometryOptions* o) { o->solver.kind = static_cast<SolverKind>(7); }),
            "'solver.kind' is none of its choices");
}

}  // namespace
}  // namespace trajlo
