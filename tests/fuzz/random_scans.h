// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

#include "core/scans/lidar_scan.h"
#include "tests/fuzz/byte_source.h"
#include "tests/support/room_recording.h"

namespace trajlo::fuzz {

/// Scans of up to three LiDARs in a room, with whatever faults the bytes ask for: clocks that jump,
/// stand still or run backwards, pauses, points that are no numbers or far away, wrong point times,
/// scans without points or without times, and a sensor that is suddenly elsewhere. A byte of zero
/// is a scan without fault that goes on from the one before.
class RandomScans {
 public:
  explicit RandomScans(ByteSource* bytes) : bytes_(*bytes) {}

  LidarScan Next() {
    LidarScan scan;
    const std::uint8_t what = bytes_.Byte();
    scan.lidar_id = (what >> 4U) % 3;
    MoveClock(what % 16);
    scan.stamp_ns = now_ns_;
    Measure(&scan);
    Spoil(bytes_.Byte() % 16, &scan);
    if (bytes_.Byte() % 8 == 1) Freeze(&scan);
    if (bytes_.Byte() % 8 == 1) scan.recorded_ns = now_ns_ + kPeriodNs + bytes_.Byte() * kMsNs;
    return scan;
  }

 private:
  static constexpr std::int64_t kMsNs = 1'000'000;
  static constexpr std::int64_t kPeriodNs = 100 * kMsNs;

  void MoveClock(int fault) {
    constexpr std::int64_t kSecondNs = 1000 * kMsNs;
    const std::int64_t steps_ns[16] = {
        kPeriodNs,  kPeriodNs,  kPeriodNs, kPeriodNs,     kPeriodNs,     kPeriodNs,      0,
        1,          -kPeriodNs, 5 * kMsNs, 3 * kPeriodNs, 2 * kSecondNs, -3 * kPeriodNs, kHourNs(),
        -kHourNs(), 0};
    std::int64_t next_ns = 0;
    if (fault == 15) {
      now_ns_ = bytes_.Int64();
    } else if (!__builtin_add_overflow(now_ns_, steps_ns[fault], &next_ns)) {
      now_ns_ = next_ns;
    }
  }
  static constexpr std::int64_t kHourNs() { return 3'600'000 * kMsNs; }

  /// The room, from where the sensor is.
  void Measure(LidarScan* scan) {
    using Room = testing::RoomRecording;
    const int columns = bytes_.OneOf({15, 30, 60, 4, 1, 0});
    const double speed_m_per_s = 0.1 * static_cast<std::int8_t>(bytes_.Byte());
    x_m_ = std::fmod(x_m_ + 0.1 * speed_m_per_s, 5.0);
    const Eigen::Vector3d origin(x_m_, 0.0, 0.0);
    for (int column = 0; column < columns; ++column) {
      const double azimuth_rad = 2.0 * M_PI * column / columns;
      for (int beam = 0; beam < 16; ++beam) {
        const double elevation_rad = (2.0 * beam - 15.0) * M_PI / 180.0;
        const Eigen::Vector3d ray(std::cos(elevation_rad) * std::cos(azimuth_rad),
                                  std::cos(elevation_rad) * std::sin(azimuth_rad),
                                  std::sin(elevation_rad));
        LidarPoint point;
        point.xyz_m = (Room::RangeTo(origin, ray) * ray).cast<float>();
        if (__builtin_add_overflow(now_ns_, kPeriodNs * column / columns, &point.t_ns)) {
          point.t_ns = now_ns_;
        }
        scan->points.push_back(point);
      }
    }
  }

  void Spoil(int fault, LidarScan* scan) {
    if (scan->points.empty()) return;
    const std::size_t step = 1 + bytes_.Byte() % 16;
    const float wild = fault == 1 ? bytes_.Float() : 0.0F;
    const std::int64_t wrong_ns = fault == 5 ? bytes_.Int64() : 0;
    for (std::size_t i = 0; i < scan->points.size(); i += step) {
      LidarPoint& point = scan->points[i];
      if (fault == 1) point.xyz_m[static_cast<int>(i % 3)] = wild;
      if (fault == 2) point.xyz_m.setConstant(std::numeric_limits<float>::quiet_NaN());
      if (fault == 3) point.xyz_m.setZero();
      if (fault == 4) point.xyz_m *= 100.0F;
      if (fault == 5) point.t_ns = wrong_ns;
      if (fault == 6) point.xyz_m.z() = 0.0F;            // One plane.
      if (fault == 7) point.xyz_m = {3.0F, 0.0F, 0.0F};  // One place.
      if (fault == 8) point.xyz_m.x() += 4.0F;           // Somewhere else.
      if (fault == 9) point.xyz_m = {point.xyz_m.y(), -point.xyz_m.x(), point.xyz_m.z()};
      if (fault == 10) point.xyz_m.tail<2>().setZero();  // One line.
    }
  }

  /// A motion-corrected scan.
  static void Freeze(LidarScan* scan) {
    scan->has_point_times = false;
    for (LidarPoint& point : scan->points) point.t_ns = scan->stamp_ns;
  }

  ByteSource& bytes_;
  std::int64_t now_ns_ = 1'600'000'000'000'000'000;
  double x_m_ = 0.0;
};

}  // namespace trajlo::fuzz
