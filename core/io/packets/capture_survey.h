// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/io/packets/capture_file.h"
#include "core/io/packets/datagram.h"
#include "core/io/packets/ouster_metadata.h"
#include "core/io/packets/packet_options.h"

namespace trajlo {

/// Datagrams that belong together: those of one sensor, or all others to one port.
struct PacketStream {
  enum class Kind { kVelodyne, kOuster, kOther };
  Kind kind = Kind::kOther;
  std::uint16_t port = 0;
  /// Of sensors only.
  IpAddress source;
  std::uint64_t datagrams = 0;
  /// Of them, those that sensors do not send beside their points (GPS and IMU data).
  std::uint64_t foreign = 0;
  /// A sensor's, but not understood: why, and what to do.
  std::string problem;

  /// Velodyne.
  std::optional<VelodyneModel> model;
  /// How far its clock runs ahead of the capture's, from the first GPRMC sentence with a fix.
  std::optional<std::int64_t> gps_ahead_ns;

  /// Ouster: into CaptureSurvey::metadata.
  std::size_t metadata = 0;
  /// From the sensor's clock to that of the capture: the median over the first packets.
  std::int64_t capture_offset_ns = 0;
  std::uint64_t serial = 0;

  /// 0 if it could not be found.
  std::uint64_t sweeps = 0;

  bool IsReadable() const { return kind != Kind::kOther && problem.empty(); }
};

struct CaptureSurvey {
  std::vector<OusterMetadata> metadata;
  std::vector<PacketStream> streams;
};

/// A pass over the heads of all packets. Throws InputError when metadata that the options name
/// cannot be used.
CaptureSurvey SurveyCapture(const std::filesystem::path& path, const PacketOptions& options,
                            CaptureFile* capture);

}  // namespace trajlo
