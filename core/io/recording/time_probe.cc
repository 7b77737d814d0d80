// SPDX-License-Identifier: MIT
#include "core/io/recording/time_probe.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/io/errors.h"
#include "core/io/scan_decoder.h"
#include "core/io/scan_stamps.h"

namespace trajlo {
namespace {

/// The first message is often partial: several of each topic are asked for their times.
constexpr std::size_t kProbedMessages = 5;
/// A LiDAR that has not spoken after so many messages of others is opened without evidence.
constexpr std::size_t kMostProbedMessages = 500;

}  // namespace

TimeProbe::TimeProbe(std::filesystem::path path, TimeOptions options)
    : path_(std::move(path)), options_(std::move(options)) {}

void TimeProbe::Note(const CloudMessage& message) {
  LidarScan scan;
  try {
    DecodeScan(path_, message.table, {}, 0, &scan);  // Throws if it has no positions.
  } catch (const InputError&) {
    return;
  }
  ++readable_;
  if (fields_.empty()) fields_ = message.table.FieldNames();
  if (message.stamp_ns) stamps_ns_.push_back(*message.stamp_ns);
  recorded_ns_.push_back(message.recorded_ns);
  if (!options_.use_point_times || message.table.count == 0) return;
  const Column* column = FindTimeColumn(message.table, options_.field);
  if (column == nullptr && !options_.field.empty()) {
    throw InputError(path_,
                     "time_field '" + options_.field +
                         "' is sought, but the messages have: " + message.table.FieldNames(),
                     "Set time_field to one of these, or leave it empty.");
  }
  if (column == nullptr || (!evidence_.field.empty() && column->name != evidence_.field)) return;
  evidence_.path = path_;
  evidence_.field = column->name;
  evidence_.type = column->type;
  if (std::optional<TimeSample> sample = SampleTimes(message.table, *column)) {
    sample->stamp_ns = message.stamp_ns;
    sample->recorded_ns = message.recorded_ns;
    evidence_.samples.push_back(*sample);
  }
}

bool TimeProbe::IsComplete() const { return readable_ >= kProbedMessages; }

bool TimeProbe::HasStamps() const {
  return std::any_of(stamps_ns_.begin(), stamps_ns_.end(), [](auto t_ns) { return t_ns != 0; });
}

TimeConvention TimeProbe::Decide() const {
  TimeConvention convention;
  TimeEvidence evidence = evidence_;
  const bool has_stamps = HasStamps();
  if (!has_stamps) {
    for (TimeSample& sample : evidence.samples) sample.stamp_ns = sample.recorded_ns;
  }
  if (!options_.use_point_times) {
    convention.evidence = "no point times: switched off by point_time none";
  } else if (evidence.field.empty()) {
    convention.evidence = "no point times: none of the fields (" + fields_ + ") has a known name";
  } else {
    evidence.period_s = TypicalPeriod(has_stamps ? stamps_ns_ : recorded_ns_);
    convention = DeduceTimeConvention(evidence, options_);
  }
  if (!has_stamps) {
    convention.evidence += "; the stamps are not filled, the time of recording stands for them";
  }
  return convention;
}

void ProbeTimes(const std::vector<std::size_t>& topics, CloudMessageReader* reader,
                std::vector<TimeProbe>* probes) {
  reader->Select(topics);
  std::size_t missing = probes->size();
  CloudMessage message;
  for (std::size_t n = 0; n < kMostProbedMessages && missing > 0 && reader->Next(&message); ++n) {
    const auto i = static_cast<std::size_t>(std::find(topics.begin(), topics.end(), message.topic) -
                                            topics.begin());
    TimeProbe& probe = (*probes)[i];
    if (probe.IsComplete()) continue;
    probe.Note(message);
    missing -= probe.IsComplete() ? 1 : 0;
  }
}

}  // namespace trajlo
