// SPDX-License-Identifier: MIT
#include "core/io/packets/ouster_geometry.h"

#include <cmath>

namespace trajlo {
namespace {

constexpr double kDegree = 0.017453292519943295;
constexpr double kTurn = 360.0 * kDegree;

}  // namespace

OusterGeometry::OusterGeometry(const OusterMetadata& metadata)
    : columns_per_frame_(metadata.columns_per_frame),
      beam_origin_m_(1e-3 * metadata.T_lidar_beam_mm.topRightCorner<3, 1>()),
      R_sensor_lidar_(metadata.T_sensor_lidar_mm.topLeftCorner<3, 3>()),
      t_sensor_lidar_m_(1e-3 * metadata.T_sensor_lidar_mm.topRightCorner<3, 1>()) {
  offset_m_ = static_cast<float>(std::hypot(beam_origin_m_.x(), beam_origin_m_.z()));
  for (std::size_t row = 0; row < metadata.rows(); ++row) {
    const double azimuth_rad = metadata.azimuth_deg[row] * kDegree;
    const double altitude_rad = metadata.altitude_deg[row] * kDegree;
    beams_.push_back({static_cast<float>(std::cos(azimuth_rad) * std::cos(altitude_rad)),
                      static_cast<float>(std::sin(azimuth_rad) * std::cos(altitude_rad)),
                      static_cast<float>(std::sin(altitude_rad))});
  }
  for (int i = 0; i < 9; ++i) R_[i] = static_cast<float>(R_sensor_lidar_(i / 3, i % 3));
}

OusterGeometry::Column OusterGeometry::At(std::size_t measurement_id) const {
  const double encoder_rad =
      kTurn * (1.0 - static_cast<double>(measurement_id) / static_cast<double>(columns_per_frame_));
  const double cos_encoder = std::cos(encoder_rad);
  const double sin_encoder = std::sin(encoder_rad);
  const Eigen::Vector3d origin_lidar_m(beam_origin_m_.x() * cos_encoder,
                                       beam_origin_m_.x() * sin_encoder, beam_origin_m_.z());
  const Eigen::Vector3d origin_m = R_sensor_lidar_ * origin_lidar_m + t_sensor_lidar_m_;
  Column column;
  column.cos_encoder = static_cast<float>(cos_encoder);
  column.sin_encoder = static_cast<float>(sin_encoder);
  for (int i = 0; i < 3; ++i) column.origin_m[i] = static_cast<float>(origin_m[i]);
  return column;
}

}  // namespace trajlo
