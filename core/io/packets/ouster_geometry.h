// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/io/packets/ouster_metadata.h"
#include "core/io/packets/sweep_points.h"

namespace trajlo {

/// From ranges to points, as Ouster's manual defines it. Column m of W looks at the encoder angle
/// θ = 2π (1 - m / W); a beam with azimuth a and altitude φ starts at distance n from the axis, so
/// that, with the angle θ - a of the beam and b the offset of its origin,
///   x = (r - n) cos(θ - a) cos φ + b_x cos θ
///   y = (r - n) sin(θ - a) cos φ + b_x sin θ
///   z = (r - n) sin φ + b_z            n = |(b_x, b_z)|
/// in the lidar frame, which the metadata's transform takes to the sensor's frame.
class OusterGeometry {
 public:
  explicit OusterGeometry(const OusterMetadata& metadata);

  /// Which way a column looks, all of it in the sensor's frame and in metres.
  struct Column {
    float cos_encoder = 1.0F;
    float sin_encoder = 0.0F;
    float origin_m[3] = {};
  };
  Column At(std::size_t measurement_id) const;

  /// Sets x, y and z.
  void Place(const Column& column, std::size_t row, std::uint32_t range_mm,
             SweepPoint* point) const {
    const Beam& beam = beams_[row];
    const float length_m = static_cast<float>(range_mm) * 1e-3F - offset_m_;
    const float forward =
        length_m * (column.cos_encoder * beam.forward + column.sin_encoder * beam.left);
    const float left =
        length_m * (column.sin_encoder * beam.forward - column.cos_encoder * beam.left);
    const float up = length_m * beam.up;
    point->x = R_[0] * forward + R_[1] * left + R_[2] * up + column.origin_m[0];
    point->y = R_[3] * forward + R_[4] * left + R_[5] * up + column.origin_m[1];
    point->z = R_[6] * forward + R_[7] * left + R_[8] * up + column.origin_m[2];
  }

 private:
  /// Of length 1, at the encoder angle 0: cos a cos φ, sin a cos φ, sin φ.
  struct Beam {
    float forward;
    float left;
    float up;
  };

  std::size_t columns_per_frame_;
  std::vector<Beam> beams_;
  float offset_m_;
  Eigen::Vector3d beam_origin_m_;
  Eigen::Matrix3d R_sensor_lidar_;
  Eigen::Vector3d t_sensor_lidar_m_;
  /// The rotation to the sensor's frame, row-major.
  float R_[9];
};

}  // namespace trajlo
