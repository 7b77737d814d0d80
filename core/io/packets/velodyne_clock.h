// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace trajlo {

/// Finds the hour of times that are only known as microseconds past the hour.
class HourClock {
 public:
  /// Without times of capture, the first packet lies in the hour that makes it nearest to
  /// `start_ns`; its default is the first hour of 1970.
  explicit HourClock(std::optional<std::int64_t> start_ns) : start_ns_(start_ns) {}

  /// Says that the sensor's clock is known to run ahead of the capture's, from a GPS sentence.
  void SetAheadOfCapture(std::int64_t ahead_ns) { ahead_ns_ = ahead_ns; }

  /// The absolute time: the nearest to the time of capture (plus what the sensor is ahead, which
  /// each packet tells anew: the hour may pass between them, and clocks drift), or to the packet
  /// before.
  std::int64_t AbsoluteNs(std::uint32_t past_hour_us, std::optional<std::int64_t> captured_ns);

 private:
  std::optional<std::int64_t> start_ns_;
  std::optional<std::int64_t> last_ns_;
  std::int64_t ahead_ns_ = 0;
};

/// True for the telemetry that Velodyne sensors send between the points.
bool IsVelodynePositionPacket(const std::uint8_t* data, std::size_t size);

/// The UTC time, ns since 1970, of the GPRMC sentence in a position packet; none if there is no
/// sentence, its checksum is wrong, or the receiver says that it has no fix.
std::optional<std::int64_t> GprmcTimeNs(const std::uint8_t* data, std::size_t size);

}  // namespace trajlo
