// SPDX-License-Identifier: MIT
#include "core/io/packets/packet_cloud_reader.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/io/errors.h"
#include "core/io/packets/ouster_stream.h"
#include "core/io/packets/velodyne_stream.h"

namespace trajlo {
namespace {

using Kind = PacketStream::Kind;

constexpr std::int64_t kHourNs = 3'600'000'000'000;

const char* NameOf(Kind kind) {
  switch (kind) {
    case Kind::kVelodyne:
      return "velodyne";
    case Kind::kOuster:
      return "ouster";
    default:
      return "udp";
  }
}

}  // namespace

PacketCloudReader::PacketCloudReader(const std::filesystem::path& path,
                                     const PacketOptions& options)
    : path_(path),
      options_(options),
      capture_(path),
      survey_(SurveyCapture(path_, options_, &capture_)) {
  NameTopics();
  RequireSweeps();
  ReportCapture();
  readings_.resize(topics_.size());
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    if (!IsCloud(topic)) continue;
    const PacketStream& stream = survey_.streams[topic];
    topics_at_[{stream.port, stream.source}].push_back(topic);
    readings_[topic] = MakeReading(topic);
  }
  capture_.Rewind();
}

bool PacketCloudReader::IsCloud(std::size_t topic) const {
  return survey_.streams[topic].IsReadable();
}

void PacketCloudReader::NameTopics() {
  for (const PacketStream& stream : survey_.streams) {
    Topic topic;
    topic.name = NameOf(stream.kind);
    // Bare payloads have no port.
    if (stream.port != 0) topic.name += ":" + std::to_string(stream.port);
    const auto same = [&](const PacketStream& other) {
      return other.kind == stream.kind && other.port == stream.port;
    };
    if (std::count_if(survey_.streams.begin(), survey_.streams.end(), same) > 1) {
      topic.name += "@" + stream.source.ToString();
    }
    topic.messages = stream.IsReadable() ? stream.sweeps : stream.datagrams;
    topic.type = "UDP datagrams";
    if (stream.kind == Kind::kVelodyne) {
      topic.type = "Velodyne packets";
      if (stream.model) topic.type = std::string(GeometryOf(*stream.model).name) + " packets";
    } else if (stream.kind == Kind::kOuster) {
      topic.type = survey_.metadata[stream.metadata].product + " packets";
    }
    topic.remark = RemarkOn(stream);
    topics_.push_back(std::move(topic));
  }
}

void PacketCloudReader::RequireSweeps() const {
  std::string others;
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    if (IsCloud(topic)) return;
    const PacketStream& stream = survey_.streams[topic];
    const std::string count = topics_[topic].name + ": " + std::to_string(stream.datagrams) + " ";
    if (!stream.problem.empty()) throw InputError(path_, count + stream.problem, "");
    if (others.size() < 300) others += (others.empty() ? "" : ", ") + count + "datagrams";
  }
  const CaptureCounts& counts = capture_.counts();
  std::string found = "no lidar packets among " + std::to_string(counts.frames) + " frames";
  if (!others.empty()) found += " (" + others + ")";
  if (counts.truncated > 0) {
    found += "; " + std::to_string(counts.truncated) + " were captured in part only";
  }
  if (counts.incomplete > 0) {
    found += "; " + std::to_string(counts.incomplete) + " lack IP fragments";
  }
  if (!counts.damage.empty()) found += "; " + counts.damage;
  throw InputError(
      path_, found,
      "Expected Velodyne packets of 1206 bytes, or Ouster packets with their metadata. "
      "Record whole packets (a snap length of 0).");
}

std::int64_t PacketCloudReader::ClockOffsetNs(const PacketStream& stream) const {
  const bool apart = std::abs(stream.capture_offset_ns) > kHourNs;
  return options_.join_clocks && apart ? stream.capture_offset_ns : 0;
}

std::string PacketCloudReader::RemarkOn(const PacketStream& stream) const {
  if (!stream.IsReadable()) return "";
  std::string remark = std::to_string(stream.datagrams) + " datagrams; ";
  if (stream.kind == Kind::kVelodyne) {
    if (stream.gps_ahead_ns) return remark + "the hour is that of the GPS";
    if (capture_.IsPayloadFile() && !options_.start_ns) {
      return remark + "the hour is not known: times count from the full hour";
    }
    return remark + "the hour is that of the capture";
  }
  const OusterMetadata& metadata = survey_.metadata[stream.metadata];
  remark += metadata.mode + " " + metadata.profile + ", metadata of " + metadata.path.string();
  const std::int64_t offset_ns = ClockOffsetNs(stream);
  if (offset_ns == 0) return remark;
  return remark + "; its clock counts from power-on, " + std::to_string(offset_ns) +
         " ns are added to join the capture's";
}

PacketCloudReader::Reading PacketCloudReader::MakeReading(std::size_t topic) const {
  const PacketStream& stream = survey_.streams[topic];
  if (stream.kind == Kind::kOuster) {
    const OusterMetadata& metadata = survey_.metadata[stream.metadata];
    OusterStreamOptions options;
    options.topic = topic;
    options.clock_offset_ns = ClockOffsetNs(stream);
    options.second_returns = options_.second_returns;
    const OusterLayout layout = *LayoutOf(metadata);
    return {std::make_unique<OusterStream>(metadata, layout, options), layout.packet_size, 0};
  }
  VelodyneStreamOptions options;
  options.topic = topic;
  options.model = *stream.model;
  options.cut_deg = options_.velodyne_cut_deg;
  options.second_returns = options_.second_returns;
  HourClock clock(options_.start_ns);
  if (stream.gps_ahead_ns) clock.SetAheadOfCapture(*stream.gps_ahead_ns);
  return {std::make_unique<VelodyneStream>(options, clock), kVelodynePacketSize, 0};
}

void PacketCloudReader::Select(const std::vector<std::size_t>& topics) {
  for (std::size_t topic = 0; topic < readings_.size(); ++topic) {
    if (std::find(topics.begin(), topics.end(), topic) == topics.end()) {
      readings_[topic].stream.reset();
    }
  }
}

void PacketCloudReader::Take(const Datagram& packet) {
  const auto at = topics_at_.find({packet.port, packet.source});
  if (at == topics_at_.end()) return;
  for (const std::size_t topic : at->second) {
    Reading& reading = readings_[topic];
    if (reading.stream == nullptr) continue;
    if (packet.size != reading.packet_size) {
      ++reading.wrong_size;
      continue;
    }
    reading.stream->Add(packet, &completed_);
  }
}

bool PacketCloudReader::Next(CloudMessage* message) {
  while (ready_.empty()) {
    if (finished_) return false;
    Datagram packet;
    if (capture_.Next(&packet)) {
      Take(packet);
    } else {
      for (Reading& reading : readings_) {
        if (reading.stream != nullptr) reading.stream->Finish(&completed_);
      }
      std::stable_sort(completed_.begin(), completed_.end(),
                       [](const auto& a, const auto& b) { return a.recorded_ns < b.recorded_ns; });
      ReportStreams();
      finished_ = true;
    }
    std::move(completed_.begin(), completed_.end(), std::back_inserter(ready_));
    completed_.clear();
  }
  *message = std::move(ready_.front());
  ready_.pop_front();
  return true;
}

}  // namespace trajlo
