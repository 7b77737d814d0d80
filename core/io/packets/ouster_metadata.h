// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "manifolds/eigen_abi.h"

namespace trajlo {

/// What the points need of an Ouster sensor's metadata. The file is the one that the sensor serves
/// over HTTP or that Ouster's tools write beside a capture: flat (until firmware 2.x) or nested.
struct OusterMetadata {
  std::filesystem::path path;
  /// "OS-1-128", "1024x10"
  std::string product;
  std::string mode;
  std::uint64_t serial = 0;
  /// To which the packets are sent; 0 if not given.
  std::uint16_t lidar_port = 0;
  /// "LEGACY", "RNG19_RFL8_SIG16_NIR16_DUAL", ...
  std::string profile;
  /// The packets begin as those of the FUSA profiles.
  bool fusa_header = false;
  std::size_t columns_per_frame = 0;
  std::size_t columns_per_packet = 0;
  /// The columns that the sensor sends, both ends included; first > last wraps around.
  std::size_t first_column = 0;
  std::size_t last_column = 0;
  /// One for each row, from the top.
  std::vector<double> altitude_deg;
  std::vector<double> azimuth_deg;
  /// Row-major 4x4 in the file, lengths in mm.
  Eigen::Matrix4d T_lidar_beam_mm = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d T_sensor_lidar_mm = Eigen::Matrix4d::Identity();

  std::size_t rows() const { return altitude_deg.size(); }
  /// Columns in the window.
  std::size_t window() const;
};

/// Throws InputError that names the missing or impossible entry.
OusterMetadata ReadOusterMetadata(const std::filesystem::path& path);

/// The files that may hold the metadata of a capture, by their names: `<capture>.json` and
/// `<capture>*.json`; else the longest name that the capture's begins with; else the only .json in
/// the folder.
std::vector<std::filesystem::path> FindOusterMetadata(const std::filesystem::path& capture);

}  // namespace trajlo
