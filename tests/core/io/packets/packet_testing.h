// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/io/packets/packet_cloud_reader.h"
#include "core/io/packets/sweep_points.h"
#include "tests/core/io/io_testing.h"

namespace trajlo {

inline void PutBig16(std::size_t value, std::string* bytes) {
  bytes->push_back(static_cast<char>(value >> 8U));
  bytes->push_back(static_cast<char>(value));
}

/// The number's bytes, the low one first.
template <typename T>
std::string Little(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

inline void SetLittle(std::string* bytes, std::size_t at, const std::string& value) {
  bytes->replace(at, value.size(), value);
}

/// A capture of Ethernet frames in the making, microseconds, low byte first.
class PcapText {
 public:
  PcapText()
      : bytes_(Little<std::uint32_t>(0xa1b2c3d4) + Little<std::uint16_t>(2) +
               Little<std::uint16_t>(4) + std::string(8, '\0') + Little<std::uint32_t>(262144) +
               Little<std::uint32_t>(1)) {}

  PcapText& AddUdp(std::int64_t captured_us, std::uint16_t port, const std::string& payload,
                   std::uint8_t host = 201) {
    std::string frame(12, '\x02');
    PutBig16(0x0800, &frame);
    frame += std::string("\x45\0", 2);
    PutBig16(28 + payload.size(), &frame);
    frame += std::string("\0\0\0\0\x40\x11\0\0\xc0\xa8\x01", 11) + static_cast<char>(host);
    frame += "\xff\xff\xff\xff";
    PutBig16(port, &frame);
    PutBig16(port, &frame);
    PutBig16(8 + payload.size(), &frame);
    frame += std::string(2, '\0') + payload;
    return AddFrame(captured_us, frame, frame.size());
  }

  /// Of `frame`, only the first `captured` bytes.
  PcapText& AddFrame(std::int64_t captured_us, const std::string& frame, std::size_t captured) {
    bytes_ += Little(static_cast<std::uint32_t>(captured_us / 1'000'000)) +
              Little(static_cast<std::uint32_t>(captured_us % 1'000'000)) +
              Little(static_cast<std::uint32_t>(captured)) +
              Little(static_cast<std::uint32_t>(frame.size())) + frame.substr(0, captured);
    return *this;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A VLP-16 packet, or one of another model: every measurement is `distance`.
struct VelodyneText {
  int azimuth_cdeg = 0;
  /// From block to block.
  int step_cdeg = 40;
  std::uint32_t time_us = 0;
  std::uint16_t distance = 5000;
  std::uint8_t return_mode = 0x37;
  std::uint8_t product = 0x22;

  std::string Bytes() const {
    std::string bytes;
    for (int block = 0; block < 12; ++block) {
      const int firing = return_mode == 0x39 ? block / 2 : block;
      bytes += Little<std::uint16_t>(0xeeff) +
               Little(static_cast<std::uint16_t>((azimuth_cdeg + firing * step_cdeg) % 36000));
      for (int laser = 0; laser < 32; ++laser) bytes += Little(distance) + '\x10';
    }
    return bytes + Little(time_us) + static_cast<char>(return_mode) + static_cast<char>(product);
  }
};

/// The packets of a VLP-16 that turns at 10 Hz, from an azimuth on; `first` is the first one's
/// number, as if those before had been lost.
constexpr double kPacketUs = 1327.104;
inline VelodyneText TurningVlp16(int number, int start_cdeg = 0, std::uint32_t start_us = 0) {
  VelodyneText packet;
  packet.azimuth_cdeg = (start_cdeg + number * 12 * packet.step_cdeg) % 36000;
  packet.time_us = start_us + static_cast<std::uint32_t>(number * kPacketUs);
  return packet;
}

struct Sweeps {
  std::vector<Topic> topics;
  std::vector<CloudMessage> sweeps;
  MessageReport report;

  std::size_t points() const {
    std::size_t count = 0;
    for (const CloudMessage& sweep : sweeps) count += sweep.table.count;
    return count;
  }
  std::string Warnings() const {
    std::string text;
    for (const std::string& warning : report.warnings) text += warning + "\n";
    return text;
  }
};

inline Sweeps ReadSweeps(const std::filesystem::path& path, const PacketOptions& options = {}) {
  PacketCloudReader reader(path, options);
  Sweeps all;
  all.topics = reader.topics();
  for (CloudMessage sweep; reader.Next(&sweep);) all.sweeps.push_back(std::move(sweep));
  all.report = reader.report();
  return all;
}

/// The table as it is laid out.
inline std::vector<SweepPoint> Points(const PointTable& table) {
  std::vector<SweepPoint> points(table.count);
  if (table.count > 0) {
    std::memcpy(points.data(), table.bytes.data(), table.count * sizeof(SweepPoint));
  }
  return points;
}

/// The points of all sweeps with times since the first sweep's stamp.
inline std::vector<SweepPoint> AllPoints(const Sweeps& all) {
  std::vector<SweepPoint> points;
  for (const CloudMessage& sweep : all.sweeps) {
    for (SweepPoint point : Points(sweep.table)) {
      point.t += static_cast<std::uint32_t>(*sweep.stamp_ns - *all.sweeps.front().stamp_ns);
      points.push_back(point);
    }
  }
  return points;
}

}  // namespace trajlo
