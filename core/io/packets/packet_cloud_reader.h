// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/io/messages/cloud_message.h"
#include "core/io/packets/capture_file.h"
#include "core/io/packets/capture_survey.h"
#include "core/io/packets/packet_options.h"
#include "core/io/packets/sweep_stream.h"

namespace trajlo {

/// The sweeps of Velodyne and Ouster sensors in a packet capture (pcap, pcapng) or in a file of
/// bare Velodyne payloads. VLP-16, Puck LITE, Puck Hi-Res, HDL-32E and VLP-32C; Ouster's legacy,
/// RNG19, RNG15 and FUSA profiles with their metadata.
///
/// A topic is a sensor: "velodyne:2368" or "ouster:7502" by the port to which it sends, with
/// "@<address>" behind it if several send to one port. Other datagrams are topics "udp:<port>".
/// A message is a sweep; one that the recording cuts is shorter, and one without a single return
/// has no points. Columns: x, y, z (float32, m, in the sensor's frame), intensity (float32, the
/// sensor's calibrated reflectivity), ring (uint16; Velodyne from the lowest beam, Ouster from the
/// highest), t (uint32, ns since the stamp). The stamp is the time of the first point: of Velodyne
/// sensors the time past the hour in the hour of the capture (or of the GPS, where it has a fix);
/// of Ouster sensors the columns' times (see PacketOptions::join_clocks).
///
/// Throws InputError when the file is no capture, or has no sweeps that can be read: the message
/// says what is there, and which metadata are missing.
class PacketCloudReader final : public CloudMessageReader {
 public:
  explicit PacketCloudReader(const std::filesystem::path& path, const PacketOptions& options = {});

  const std::vector<Topic>& topics() const override { return topics_; }
  bool IsCloud(std::size_t topic) const override;
  void Select(const std::vector<std::size_t>& topics) override;
  bool Next(CloudMessage* message) override;
  /// Losses of single sensors are listed when the end is reached.
  const MessageReport& report() const override { return report_; }

 private:
  struct Reading {
    std::unique_ptr<SweepStream> stream;
    std::size_t packet_size = 0;
    std::uint64_t wrong_size = 0;
  };

  void NameTopics();
  void RequireSweeps() const;
  /// Topic::remark.
  std::string RemarkOn(const PacketStream& stream) const;
  Reading MakeReading(std::size_t topic) const;
  std::int64_t ClockOffsetNs(const PacketStream& stream) const;
  void Take(const Datagram& packet);
  bool IsPortOfSensor(std::uint16_t port) const;
  void ReportCapture();
  void ReportStreams();

  std::filesystem::path path_;
  PacketOptions options_;
  CaptureFile capture_;
  CaptureSurvey survey_;
  std::vector<Topic> topics_;
  MessageReport report_;
  /// The sensor's topic by port and source.
  std::map<std::tuple<std::uint16_t, IpAddress>, std::vector<std::size_t>> topics_at_;
  /// By topic; without a stream where nothing is read.
  std::vector<Reading> readings_;
  std::vector<CloudMessage> completed_;
  std::deque<CloudMessage> ready_;
  bool finished_ = false;
};

}  // namespace trajlo
