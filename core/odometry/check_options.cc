// SPDX-License-Identifier: MIT
#include "core/odometry/check_options.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/options/number_text.h"

namespace trajlo {
namespace {

std::string ValueText(double value) { return NumberText(value); }
std::string ValueText(int value) { return std::to_string(value); }

/// The describer of options structs (see core/options/describe.h) that looks at each value alone.
class RangeCheck {
 public:
  RangeCheck& In(const std::string& section) {
    section_ = section;
    return *this;
  }

  void operator()(OptionFor, const char*, bool&, const char*) {}

  template <typename Number>
  void operator()(OptionFor audience, const char* name, Number& value, Range<Number> range,
                  const char*) {
    if (value >= range.min && value <= range.max) return;
    Fail(audience, name,
         "must be " + RangeText(range.min, range.max) + ", found " + ValueText(value));
  }

  template <typename Choice>
  void operator()(OptionFor audience, const char* name, Choice& value, const Names<Choice>& names,
                  const char*) {
    const bool is_known = std::any_of(names.begin(), names.end(),
                                      [&](const auto& known) { return known.second == value; });
    if (!is_known) Fail(audience, name, "is none of its choices");
  }

  void operator()(OptionFor audience, const char* name, std::vector<SE3>& values, const char*) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string which = "that of LiDAR " + std::to_string(i);
      if (!values[i].IsFinite()) Fail(audience, name, "must be finite: " + which + " is not");
      const double norm = values[i].q.norm();
      if (std::abs(norm - 1.0) <= kNormTolerance) continue;
      Fail(audience, name,
           "needs unit quaternions: " + which + " has the norm " + NumberText(norm));
    }
  }

 private:
  /// Numbers of single precision are within.
  static constexpr double kNormTolerance = 1e-6;

  [[noreturn]] void Fail(OptionFor audience, const char* name, const std::string& what) const {
    throw std::invalid_argument("'" + OptionKey(audience, section_, name) + "' " + what);
  }

  std::string section_;
};

struct Value {
  const char* key;
  double value;
  double times = 1.0;  // what is compared is this multiple

  double Compared() const { return times * value; }
};

/// A multiple is not multiplied out: 3 x 0.1 would be 0.30000000000000004.
std::string Text(const Value& v) {
  const std::string times = v.times == 1.0 ? "" : NumberText(v.times) + " x ";
  return times + v.key + " (" + times + NumberText(v.value) + ")";
}

void RequireLess(const Value& a, const Value& b, const char* why) {
  if (a.Compared() < b.Compared()) return;
  throw std::invalid_argument(Text(a) + " must be less than " + Text(b) + ": " + why);
}

void RequireAtMost(const Value& a, const Value& b, const char* why) {
  if (a.Compared() <= b.Compared()) return;
  throw std::invalid_argument(Text(a) + " must not exceed " + Text(b) + ": " + why);
}

void CheckSegmenter(const SegmenterOptions& segmenter, double first_interval_s) {
  RequireLess({"sensor.min_range_m", segmenter.min_range_m},
              {"sensor.max_range_m", segmenter.max_range_m}, "otherwise no point is left");
  RequireAtMost({"expert.segmenter.map_voxel_m", segmenter.map_voxel_m},
                {"expert.segmenter.registration_voxel_m", segmenter.registration_voxel_m},
                "the points to register are taken from those for the map");
  RequireAtMost({"segmenter.interval_s", segmenter.interval_s},
                {"expert.initialization.first_interval_s", first_interval_s},
                "the first interval is made of whole segments");
  RequireLess({"segmenter.interval_s", segmenter.interval_s},
              {"expert.segmenter.max_gap_s", segmenter.max_gap_s},
              "otherwise the time between two segments would count as a pause");
}

void CheckMap(const MapOptions& map) {
  RequireLess(
      {"expert.map.min_point_spacing_m", map.min_point_spacing_m},
      {"map.voxel_size_m", map.voxel_size_m},
      "otherwise a voxel holds one point, and no plane is found; 0.4 of the voxel is a good value");
  RequireLess({"map.voxel_size_m", map.voxel_size_m}, {"map.radius_m", map.radius_m},
              "otherwise the map holds nothing");
}

void CheckRegistration(const RegistrationOptions& registration) {
  if (registration.kernel == KernelKind::kNone || registration.kernel_in_spreads <= 0.0) return;
  RequireAtMost({"registration.sigma_m", registration.sigma_m},
                {"expert.registration.kernel_m", registration.kernel_m, kWidestKernel},
                "the fitted kernel is between the two");
}

}  // namespace

void CheckOptions(const OdometryOptions& options) {
  OdometryOptions described = options;  // Describers may write.
  RangeCheck check;
  described.DescribeAll(check);
  CheckSegmenter(options.segmenter, options.initialization.first_interval_s);
  CheckMap(options.map.finest);
  CheckRegistration(options.registration);
}

}  // namespace trajlo
