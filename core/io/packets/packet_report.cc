// SPDX-License-Identifier: MIT
// What PacketCloudReader says about losses.
#include <algorithm>

#include "core/io/format_text.h"
#include "core/io/packets/packet_cloud_reader.h"

namespace trajlo {

bool PacketCloudReader::IsPortOfSensor(std::uint16_t port) const {
  return std::any_of(survey_.streams.begin(), survey_.streams.end(), [&](const auto& stream) {
    return stream.IsReadable() && stream.port == port;
  });
}

void PacketCloudReader::ReportCapture() {
  const CaptureCounts& counts = capture_.counts();
  const auto warn = [&](const std::string& sentence) {
    report_.warnings.push_back(path_.string() + ": " + sentence);
  };
  report_.bytes_lost = counts.bytes_lost;
  report_.damaged = !counts.damage.empty() || counts.truncated > 0 || counts.incomplete > 0;
  if (!counts.damage.empty()) warn(counts.damage);
  if (counts.truncated > 0) {
    warn(CountOf(counts.truncated, "packet was captured in part only and is left out",
                 "packets were captured in part only and are left out") +
         " (record with a snap length of 0)");
  }
  if (counts.incomplete > 0) {
    warn(CountOf(counts.incomplete, "packet lacks IP fragments and is left out",
                 "packets lack IP fragments and are left out"));
  }
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    const PacketStream& stream = survey_.streams[topic];
    const std::string& name = topics_[topic].name;
    if (!stream.problem.empty()) {
      warn(name + ": " + std::to_string(stream.datagrams) + " " + stream.problem);
    } else if (stream.foreign > 0 && !IsPortOfSensor(stream.port)) {
      warn(name + ": " +
           CountOf(stream.foreign, "datagram is not a LiDAR packet and is ignored",
                   "datagrams are not LiDAR packets and are ignored"));
    }
  }
}

void PacketCloudReader::ReportStreams() {
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    const Reading& reading = readings_[topic];
    if (reading.stream == nullptr) continue;
    const StreamCounts& counts = reading.stream->counts();
    const auto warn = [&](std::uint64_t count, const char* one, const char* many) {
      if (count == 0) return;
      report_.warnings.push_back(path_.string() + ": " + topics_[topic].name + ": " +
                                 CountOf(count, one, many));
    };
    report_.damaged =
        report_.damaged || reading.wrong_size > 0 || counts.broken > 0 || counts.broken_columns > 0;
    const bool ouster = survey_.streams[topic].kind == PacketStream::Kind::kOuster;
    warn(reading.wrong_size, "datagram has another size than its packets and is left out",
         "datagrams have another size than its packets and are left out");
    warn(counts.broken, "packet contradicts itself and is left out",
         "packets contradict themselves and are left out");
    warn(counts.broken_columns, "column has an impossible number or time and is left out",
         "columns have an impossible number or time and are left out");
    if (ouster) {
      warn(counts.duplicates, "column came twice", "columns came twice");
      warn(counts.missing, "column of whole sweeps never came (lost packets)",
           "columns of whole sweeps never came (lost packets)");
    } else {
      warn(counts.duplicates, "packet came twice", "packets came twice");
      warn(counts.missing, "packet never came (a gap between the others)",
           "packets never came (gaps between the others)");
    }
    warn(counts.late, "packet came too late for its sweep and is left out",
         "packets came too late for their sweeps and are left out");
  }
}

}  // namespace trajlo
