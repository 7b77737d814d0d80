// SPDX-License-Identifier: MIT
#include "core/io/recording/cloud_recording.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "core/io/errors.h"
#include "core/io/format_text.h"
#include "core/io/messages/fixed_frame.h"
#include "core/io/recording/probe_times.h"
#include "core/io/scan_decoder.h"
#include "core/scans/nanoseconds.h"
#include "core/scans/scan_times.h"

namespace trajlo {
namespace {

std::string CloudTopics(const CloudMessageReader& reader) {
  std::string text;
  for (std::size_t i = 0; i < reader.topics().size(); ++i) {
    const Topic& topic = reader.topics()[i];
    if (!reader.IsCloud(i)) continue;
    text +=
        "\n    " + topic.name + " (" + topic.type + ", " + CountOf(topic.messages, "message") + ")";
  }
  return text.empty() ? " none" : text;
}

/// The places of the topics to read, in the order of the LiDARs.
std::vector<std::size_t> ChooseTopics(const std::filesystem::path& path,
                                      const CloudMessageReader& reader,
                                      const std::vector<std::string>& wanted) {
  std::vector<std::size_t> chosen;
  if (wanted.empty()) {
    for (std::size_t i = 0; i < reader.topics().size(); ++i) {
      if (reader.IsCloud(i)) chosen.push_back(i);
    }
    if (chosen.size() == 1) return chosen;
    throw InputError(path, "the topics with point clouds are:" + CloudTopics(reader),
                     chosen.empty() ? "There is nothing to run on."
                                    : "Choose with input.topics: one of them, or a list [a, b] "
                                      "for several LiDARs.");
  }
  for (const std::string& name : wanted) {
    std::size_t i = 0;
    while (i < reader.topics().size() && !(reader.topics()[i].name == name && reader.IsCloud(i))) {
      ++i;
    }
    if (i == reader.topics().size()) {
      throw InputError(
          path, "no topic '" + name + "' with point clouds; there are:" + CloudTopics(reader),
          "Set input.topics to one of these.");
    }
    chosen.push_back(i);
  }
  return chosen;
}

}  // namespace

CloudRecording::CloudRecording(const std::filesystem::path& path, const Open& open,
                               const RecordingOptions& options, std::size_t first_lidar_id,
                               bool read_ahead)
    : path_(path), read_ahead_(read_ahead), reader_(open()) {
  SelectStreams(options, first_lidar_id);
  Probe(open().get(), options);
  Describe();
  StartNext({});
}

void CloudRecording::SelectStreams(const RecordingOptions& options, std::size_t first_lidar_id) {
  const std::vector<std::size_t> topics = ChooseTopics(path_, *reader_, options.topics);
  reader_->Select(topics);
  for (const std::size_t topic : topics) {
    const std::size_t id = first_lidar_id + streams_.size();
    streams_.push_back(
        {topic, {}, Nanoseconds(options.clock_offset_s.Of(id)), static_cast<int>(id), false});
    NoteTopic(reader_->topics()[topic], id);
  }
}

void CloudRecording::NoteTopic(const Topic& topic, std::size_t lidar_id) {
  report_.scans_listed += topic.messages;
  if (topic.messages > 0) return;
  report_.topics_without_messages.push_back(topic.name);
  report_.warnings.push_back(path_.string() + ": topic " + topic.name + " has no message: LiDAR " +
                             std::to_string(lidar_id) + " is not used");
}

/// Decides the time convention of each LiDAR from its first messages.
void CloudRecording::Probe(CloudMessageReader* reader, const RecordingOptions& options) {
  std::vector<std::size_t> topics;
  std::vector<TimeProbe> probes;
  for (const Stream& stream : streams_) {
    topics.push_back(stream.topic);
    probes.emplace_back(path_, options.TimeOf(static_cast<std::size_t>(stream.lidar_id)));
  }
  const std::vector<std::string> frame_ids = ProbeTimes(topics, reader, &probes);
  const bool none = std::all_of(probes.begin(), probes.end(),
                                [](const TimeProbe& one) { return one.readable() == 0; });
  if (none) {
    const auto& warnings = reader->report().warnings;
    std::string why;
    for (const TimeProbe& probe : probes) why = why.empty() ? probe.problem() : why;
    throw InputError(path_, "no message with points can be read" + (why.empty() ? "" : ": " + why),
                     warnings.empty() ? "" : warnings.front());
  }
  for (std::size_t i = 0; i < streams_.size(); ++i) {
    streams_[i].stamp_is_recorded = !probes[i].HasStamps();
    streams_[i].convention = probes[i].Decide();
    const std::string& topic = reader_->topics()[streams_[i].topic].name;
    const std::string unfilled =
        streams_[i].stamp_is_recorded && probes[i].readable() > 0
            ? "the stamps are zero: times of recording, which follow the end of the sweep, stand "
              "for them, and the recorder's jitter is in all times"
            : "";
    for (const std::string& doubt :
         {streams_[i].convention.doubt, unfilled, DoubtOfFrame(frame_ids[i])}) {
      if (doubt.empty()) continue;
      report_.warnings.push_back(path_.string() + ": " + topic + ": " + doubt);
    }
  }
}

void CloudRecording::Describe() {
  for (const Stream& stream : streams_) {
    const Topic& topic = reader_->topics()[stream.topic];
    description_ += (description_.empty() ? "" : "\n") + path_.string() + ": lidar " +
                    std::to_string(stream.lidar_id) + " is " + topic.name + " (" + topic.type +
                    "), " + CountOf(topic.messages, "message") +
                    (topic.remark.empty() ? "" : "; " + topic.remark);
    description_ +=
        topic.messages == 0 ? ": it is not used" : "\npoint times: " + stream.convention.evidence;
  }
}

CloudRecording::Outcome CloudRecording::Decode(LidarScan reused) {
  Outcome outcome;
  outcome.scan = std::move(reused);
  if (!reader_->Next(&message_)) return outcome;
  outcome.found = true;
  const auto stream = std::find_if(streams_.begin(), streams_.end(),
                                   [&](const Stream& one) { return one.topic == message_.topic; });
  const std::string where = path_.string() + ": " + reader_->topics()[message_.topic].name;
  try {
    outcome.damage = message_.table.damage.empty() ? "" : where + ": " + message_.table.damage;
    const TimeConvention& convention = stream->convention;
    if (convention.HasPointTimes() && FindTimeColumn(message_.table, convention.field) == nullptr) {
      outcome.damage = where + ": a message has no field '" + convention.field +
                       "', all its points get the stamp";
    }
    const auto stamp_ns = stream->stamp_is_recorded ? message_.recorded_ns : message_.stamp_ns;
    outcome.points_undeclared = message_.table.undeclared;
    outcome.points_without_time =
        DecodeScan(path_, message_.table, convention, stamp_ns, &outcome.scan);
    ShiftTimes(stream->clock_offset_ns, &outcome.scan);
    outcome.scan.lidar_id = stream->lidar_id;
    outcome.scan.recorded_ns = message_.recorded_ns;
    outcome.readable = true;
  } catch (const std::exception& error) {
    outcome.damage = error.what();
  }
  return outcome;
}

void CloudRecording::StartNext(LidarScan reused) {
  const auto policy = read_ahead_ ? std::launch::async : std::launch::deferred;
  ahead_ = std::async(policy, &CloudRecording::Decode, this, std::move(reused));
}

bool CloudRecording::Next(LidarScan* scan) {
  while (ahead_.valid()) {
    Outcome outcome = ahead_.get();
    // Nothing runs in the background here, so the reader's report is still.
    TakeOver(reader_->report());
    if (!outcome.found) return false;
    if (!outcome.damage.empty()) report_.warnings.push_back(outcome.damage);
    if (!outcome.readable) {
      ++report_.scans_skipped;
      StartNext(std::move(outcome.scan));
      continue;
    }
    std::swap(*scan, outcome.scan);
    StartNext(std::move(outcome.scan));
    ++report_.scans_read;
    report_.scans_damaged += outcome.damage.empty() ? 0 : 1;
    report_.points_read += scan->points.size();
    report_.points_without_time += outcome.points_without_time;
    report_.points_undeclared += outcome.points_undeclared;
    return true;
  }
  return false;
}

void CloudRecording::TakeOver(const MessageReport& message_report) {
  report_.file_is_cut = message_report.damaged;
  for (; warnings_taken_ < message_report.warnings.size(); ++warnings_taken_) {
    report_.warnings.push_back(message_report.warnings[warnings_taken_]);
  }
}

}  // namespace trajlo
