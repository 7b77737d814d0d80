// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace trajlo::testing {

/// A recording of a spinning 16-beam LiDAR in a box-shaped room, at rest and then along x.
struct RoomRecording {
  int scans = 12;
  double speed_m_per_s = 0.5;
  double rest_s = 0.4;
  int columns = 360;
  Eigen::Vector3d sensor_at = Eigen::Vector3d::Zero();

  static constexpr double kPeriod = 0.1;
  static constexpr double kStart = 1000.0;

  /// Where the body is, `t` seconds after the start.
  double PositionX(double t) const { return speed_m_per_s * std::max(0.0, t - rest_s); }

  /// Distance from `origin` along the unit vector `ray` to the walls of the room.
  static double RangeTo(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
    const Eigen::Vector3d low(-6.0, -4.0, -1.5), high(9.0, 5.0, 3.0);
    double range = std::numeric_limits<double>::max();
    for (int axis = 0; axis < 3; ++axis) {
      if (ray[axis] == 0.0) continue;
      const double wall = ray[axis] > 0.0 ? high[axis] : low[axis];
      range = std::min(range, (wall - origin[axis]) / ray[axis]);
    }
    return range;
  }

  /// x y z time of one scan; time in seconds from its start.
  std::vector<Eigen::Vector4f> Scan(int index) const {
    std::vector<Eigen::Vector4f> points;
    for (int column = 0; column < columns; ++column) {
      const double t = kPeriod * column / columns;
      const double azimuth = 2.0 * M_PI * column / columns;
      const Eigen::Vector3d origin =
          sensor_at + Eigen::Vector3d(PositionX(index * kPeriod + t), 0.0, 0.0);
      for (int beam = 0; beam < 16; ++beam) {
        const double elevation = (2.0 * beam - 15.0) * M_PI / 180.0;
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const Eigen::Vector3f p = (RangeTo(origin, ray) * ray).cast<float>();
        points.emplace_back(p.x(), p.y(), p.z(), static_cast<float>(t));
      }
    }
    return points;
  }

  static std::filesystem::path File(const std::filesystem::path& folder, int index) {
    char name[20];
    std::snprintf(name, sizeof(name), "%06d.pcd", index);
    return folder / "scans" / name;
  }

  static void WriteScan(const std::filesystem::path& file,
                        const std::vector<Eigen::Vector4f>& points) {
    std::ofstream stream(file, std::ios::binary);
    const std::string count = std::to_string(points.size());
    stream << "VERSION 0.7\nFIELDS x y z time\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH "
           << count << "\nHEIGHT 1\nPOINTS " << count << "\nDATA binary\n";
    stream.write(reinterpret_cast<const char*>(points.data()),
                 static_cast<std::streamsize>(points.size() * sizeof(points[0])));
  }

  void Write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder / "scans");
    std::ofstream stamps(folder / "timestamps.txt");
    for (int i = 0; i < scans; ++i) {
      WriteScan(File(folder, i), Scan(i));
      stamps << std::to_string(kStart + i * kPeriod) << "\n";
    }
  }
};

}  // namespace trajlo::testing
