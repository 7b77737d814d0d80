// SPDX-License-Identifier: MIT
#include "core/io/time_probe.h"

#include <algorithm>
#include <iterator>
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

/// What usual drivers write that is no time.
constexpr const char* kNoTimes[] = {
    "x",       "y",        "z",        "intensity", "i",           "reflectivity", "remission",
    "signal",  "ring",     "line",     "channel",   "reflectance", "laser_id",     "laserid",
    "scan_id", "tag",      "ambient",  "noise",     "near_ir",     "nearir",       "range",
    "row",     "column",   "rgb",      "rgba",      "label",       "azimuth",      "elevation",
    "flags",   "normal_x", "normal_y", "normal_z",  "return_type", "return_number"};

/// "a, b": fields that nothing is known about.
std::string UnknownFields(const PointTable& table) {
  const std::vector<const Column*> times = TimeColumns(table);
  std::string names;
  for (const Column& column : table.columns) {
    const std::string name = NormalisedFieldName(column.name);
    const bool is_known = std::any_of(std::begin(kNoTimes), std::end(kNoTimes),
                                      [&](const char* known) { return name == known; });
    if (is_known || std::count(times.begin(), times.end(), &column) > 0) continue;
    names += (names.empty() ? "" : ", ") + column.name;
  }
  return names;
}

bool HasPositions(const PointTable& table) {
  return table.Find("x") != nullptr && table.Find("y") != nullptr && table.Find("z") != nullptr;
}

}  // namespace

TimeProbe::TimeProbe(std::filesystem::path path, TimeOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

bool TimeProbe::Note(const std::filesystem::path& where, const PointTable& table,
                     std::optional<std::int64_t> stamp_ns,
                     std::optional<std::int64_t> recorded_ns) {
  if (!HasPositions(table)) {
    if (problem_.empty()) {
      problem_ = "a scan needs the fields x, y and z, but there are: " + table.FieldNames();
    }
    return false;
  }
  ++readable_;
  if (stamp_ns) stamps_ns_.push_back(*stamp_ns);
  if (recorded_ns) recorded_ns_.push_back(*recorded_ns);
  if (table.count == 0) return true;
  if (with_points_++ == 0) {
    fields_ = table.FieldNames();
    unknown_fields_ = UnknownFields(table);
  }
  for (const Column* column : ColumnsOf(where, table)) {
    if (!options_.use_point_times) {
      NoteIgnored(table, *column);
      continue;
    }
    Candidate& candidate = CandidateOf(where, *column);
    std::optional<TimeSample> sample = SampleTimes(table, *column);
    if (!sample) continue;
    const bool is_rich = sample->points >= kFewestPoints;
    if (sample->first == sample->last) {
      candidate.constant += is_rich ? 1 : 0;
      continue;
    }
    sample->stamp_ns = stamp_ns;
    sample->recorded_ns = recorded_ns;
    (is_rich ? candidate.samples : candidate.poor_samples).push_back(*sample);
  }
  return true;
}

std::vector<const Column*> TimeProbe::ColumnsOf(const std::filesystem::path& where,
                                                const PointTable& table) const {
  if (options_.field.empty()) return TimeColumns(table);
  if (const Column* column = FindTimeColumn(table, options_.field)) return {column};
  if (!options_.use_point_times) return {};
  throw InputError(where,
                   "there is no field '" + options_.field +
                       "' (input.time_field); the points have: " + table.FieldNames(),
                   "Set input.time_field to one of these, or leave it empty.");
}

TimeProbe::Candidate& TimeProbe::CandidateOf(const std::filesystem::path& where,
                                             const Column& column) {
  const auto known =
      std::find_if(candidates_.begin(), candidates_.end(),
                   [&](const Candidate& candidate) { return candidate.field == column.name; });
  if (known != candidates_.end()) return *known;
  candidates_.push_back({where, column.name, column.type, {}, {}});
  return candidates_.back();
}

void TimeProbe::NoteIgnored(const PointTable& table, const Column& column) {
  const std::optional<TimeSample> sample = SampleTimes(table, column);
  if (sample && sample->points >= kFewestPoints && sample->first != sample->last) {
    ignored_field_ = column.name;
  }
}

bool TimeProbe::IsComplete() const {
  if (readable_ >= kMostScans) return true;
  if (!options_.use_point_times) return readable_ >= kUsable;
  if (candidates_.empty()) return with_points_ >= kUsable;
  for (const Candidate& candidate : candidates_) {
    if (candidate.samples.size() >= kUsable) return true;
    const bool seems_constant = candidate.samples.empty() && candidate.constant >= kUsable;
    if (!seems_constant) return false;
  }
  return candidates_.front().constant >= kConstant;
}

bool TimeProbe::HasStamps() const {
  return std::any_of(stamps_ns_.begin(), stamps_ns_.end(), [](auto t_ns) { return t_ns != 0; });
}

/// Unlike those of a folder, which has none.
bool TimeProbe::StampsAreUnfilled() const {
  return !stamps_ns_.empty() && !HasStamps() && !recorded_ns_.empty();
}

const TimeProbe::Candidate* TimeProbe::Chosen() const {
  for (const Candidate& candidate : candidates_) {
    const bool has_poor = candidate.constant == 0 && !candidate.poor_samples.empty();
    if (!candidate.samples.empty() || has_poor) return &candidate;
  }
  return nullptr;
}

std::string TimeProbe::ConstantFields() const {
  std::string names;
  for (const Candidate& candidate : candidates_) {
    if (candidate.constant == 0 || !candidate.samples.empty()) continue;
    names += (names.empty() ? "'" : ", '") + candidate.field + "'";
  }
  return names;
}

TimeConvention TimeProbe::DecideWithoutTimes() const {
  const std::string blur =
      "points have no times of their own: right for motion-corrected scans only, others blur with "
      "every turn (input.point_time=none says that they are corrected" +
      (unknown_fields_.empty() ? ")"
                               : "; if one of the fields " + unknown_fields_ +
                                     " has the times, name it with input.time_field)");
  const std::string scans = std::to_string(readable_);
  const std::string constant = ConstantFields();
  TimeConvention convention;
  if (!options_.use_point_times) {
    convention.evidence = "no point times: switched off by point_time none";
    if (!ignored_field_.empty()) {
      convention.doubt = "points have times (field '" + ignored_field_ +
                         "'), which input.point_time=none ignores: right for motion-corrected "
                         "scans only, others blur with every turn";
    }
  } else if (with_points_ > 0 && candidates_.empty()) {
    convention.evidence = "no point times: none of the fields (" + fields_ + ") has a known name";
    convention.doubt = blur;
  } else if (!constant.empty()) {
    convention.evidence = "no point times: field " + constant +
                          " is the same for all points of each of the first " + scans + " scans";
    convention.doubt = blur;
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

TimeConvention TimeProbe::DecideBy(const Candidate& candidate) const {
  TimeEvidence evidence;
  evidence.path = candidate.where;
  evidence.field = candidate.field;
  evidence.type = candidate.type;
  evidence.samples = candidate.samples.empty() ? candidate.poor_samples : candidate.samples;
  const bool has_stamps = HasStamps();
  if (!has_stamps) {
    for (TimeSample& sample : evidence.samples) sample.stamp_ns = sample.recorded_ns;
  }
  evidence.period_s = period_s_;
  if (evidence.period_s == 0.0) {
    evidence.period_s = TypicalPeriod(has_stamps ? stamps_ns_ : recorded_ns_);
  }
  TimeOptions options = options_;
  // A message is recorded when its sweep has ended.
  if (StampsAreUnfilled() && options.stamp_at == StampAt::kAuto) options.stamp_at = StampAt::kEnd;
  TimeConvention convention = DeduceTimeConvention(evidence, options);
  if (const std::string constant = ConstantFields(); !constant.empty()) {
    convention.evidence =
        "field " + constant + " is the same for all points of a scan; " + convention.evidence;
  }
  return convention;
}

TimeConvention TimeProbe::DecideByOther(const Candidate& candidate) const {
  try {
    return DecideBy(candidate);
  } catch (const InputError&) {
    TimeConvention convention = DecideWithoutTimes();
    convention.doubt += "; what field '" + candidate.field +
                        "' holds is not known (input.time_field, input.time_unit)";
    return convention;
  }
}

TimeConvention TimeProbe::Decide() const {
  const Candidate* chosen = Chosen();
  TimeConvention convention = chosen == nullptr                ? DecideWithoutTimes()
                              : chosen == &candidates_.front() ? DecideBy(*chosen)
                                                               : DecideByOther(*chosen);
  if (StampsAreUnfilled()) {
    convention.evidence +=
        "; the stamps are zero: times of recording, which follow the end of the sweep, stand for "
        "them";
  }
  return convention;
}

}  // namespace trajlo
