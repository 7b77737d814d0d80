// SPDX-License-Identifier: MIT
#include "core/io/time_probe.h"

#include <algorithm>
#include <utility>

#include "core/io/errors.h"
#include "core/io/scan_decoder.h"
#include "core/io/scan_stamps.h"

namespace trajlo {
namespace {

/// Several scans, as the first is often partial, and one may be broken.
constexpr std::size_t kUsable = 5;
/// Times that are the same for all points of this many scans are no times.
constexpr std::size_t kConstant = 20;
/// With fewer points, the ends of a sweep are anywhere.
constexpr std::size_t kFewestPoints = 10;

bool HasPositions(const PointTable& table) {
  return table.Find("x") != nullptr && table.Find("y") != nullptr && table.Find("z") != nullptr;
}

}  // namespace

TimeProbe::TimeProbe(std::filesystem::path path, TimeOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

bool TimeProbe::Note(const std::filesystem::path& where, const PointTable& table,
                     std::optional<std::int64_t> stamp_ns,
                     std::optional<std::int64_t> recorded_ns) {
  if (!HasPositions(table)) return false;
  ++readable_;
  if (stamp_ns) stamps_ns_.push_back(*stamp_ns);
  if (recorded_ns) recorded_ns_.push_back(*recorded_ns);
  if (table.count == 0) return true;
  if (with_points_++ == 0) fields_ = table.FieldNames();
  const Column* column = FindTimeColumn(table, options_.field);
  if (!options_.use_point_times) {
    if (column != nullptr) NoteIgnored(table, *column);
    return true;
  }
  if (column == nullptr && !options_.field.empty()) {
    throw InputError(where,
                     "there is no field '" + options_.field +
                         "' (input.time_field); the points have: " + table.FieldNames(),
                     "Set input.time_field to one of these, or leave it empty.");
  }
  if (column == nullptr || (!evidence_.field.empty() && column->name != evidence_.field)) {
    return true;
  }
  evidence_.path = where;
  evidence_.field = column->name;
  evidence_.type = column->type;
  std::optional<TimeSample> sample = SampleTimes(table, *column);
  if (!sample) return true;
  const bool is_rich = sample->points >= kFewestPoints;
  if (sample->first == sample->last) {
    constant_ += is_rich ? 1 : 0;
    return true;
  }
  sample->stamp_ns = stamp_ns;
  sample->recorded_ns = recorded_ns;
  (is_rich ? evidence_.samples : poor_samples_).push_back(*sample);
  return true;
}

void TimeProbe::NoteIgnored(const PointTable& table, const Column& column) {
  const std::optional<TimeSample> sample = SampleTimes(table, column);
  if (sample && sample->points >= kFewestPoints && sample->first != sample->last) {
    ignored_field_ = column.name;
  }
}

bool TimeProbe::IsComplete() const {
  if (readable_ >= kMostScans || evidence_.samples.size() >= kUsable) return true;
  if (!options_.use_point_times) return readable_ >= kUsable;
  if (evidence_.field.empty()) return with_points_ >= kUsable;
  return constant_ >= kConstant;
}

bool TimeProbe::HasStamps() const {
  return std::any_of(stamps_ns_.begin(), stamps_ns_.end(), [](auto t_ns) { return t_ns != 0; });
}

TimeConvention TimeProbe::DecideWithoutTimes() const {
  constexpr char kBlur[] =
      "points have no times of their own: right for motion-corrected scans only, others blur with "
      "every turn (input.point_time=none says that they are corrected)";
  const std::string scans = std::to_string(readable_);
  TimeConvention convention;
  if (!options_.use_point_times) {
    convention.evidence = "no point times: switched off by point_time none";
    if (!ignored_field_.empty()) {
      convention.doubt = "points have times (field '" + ignored_field_ +
                         "'), which input.point_time=none ignores: right for motion-corrected "
                         "scans only, others blur with every turn";
    }
  } else if (with_points_ > 0 && evidence_.field.empty()) {
    convention.evidence = "no point times: none of the fields (" + fields_ + ") has a known name";
    convention.doubt = kBlur;
  } else if (constant_ > 0) {
    convention.evidence = "no point times: field '" + evidence_.field +
                          "' is the same for all points of each of the first " + scans + " scans";
    convention.doubt = kBlur;
  } else {
    convention.evidence = "no point times: none of the first " + scans + " scans has enough points";
  }
  const bool is_asked_for =
      options_.use_point_times && (!options_.field.empty() || options_.unit != TimeUnit::kAuto ||
                                   options_.origin != TimeOrigin::kAuto);
  if (is_asked_for) {
    throw InputError(
        path_, "point times are asked for, but there are " + convention.evidence,
        "Leave input.time_field empty and input.time_unit and input.time_origin at auto, "
        "or set input.point_time to none.");
  }
  return convention;
}

TimeConvention TimeProbe::Decide() const {
  TimeEvidence evidence = evidence_;
  if (evidence.samples.empty() && constant_ == 0) evidence.samples = poor_samples_;
  const bool has_stamps = HasStamps();
  if (!has_stamps) {
    for (TimeSample& sample : evidence.samples) sample.stamp_ns = sample.recorded_ns;
  }
  if (evidence.period_s == 0.0) {
    evidence.period_s = TypicalPeriod(has_stamps ? stamps_ns_ : recorded_ns_);
  }
  TimeConvention convention =
      evidence.samples.empty() ? DecideWithoutTimes() : DeduceTimeConvention(evidence, options_);
  if (!has_stamps && !recorded_ns_.empty()) {
    convention.evidence += "; the stamps are not filled, the time of recording stands for them";
  }
  return convention;
}

}  // namespace trajlo
