// SPDX-License-Identifier: MIT
#include "core/io/packets/velodyne_model.h"

#include <algorithm>
#include <cmath>

namespace trajlo {
namespace {

constexpr double kDegree = 0.017453292519943295;

/// As the manuals list them: by laser, which is also the order of firing.
struct LaserTable {
  std::array<double, 32> elevation_deg{};
  std::array<double, 32> up_mm{};
  std::array<double, 32> azimuth_offset_deg{};
};

constexpr LaserTable kVlp16Lasers{
    {-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15},
    {11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1, 5.1, -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2},
    {}};

/// The manual rounds these elevations, multiples of 2/3 degrees, to 0.01 degrees.
constexpr LaserTable kPuckHiResLasers{
    {-10, 0.667, -8.667, 2, -7.333, 3.333, -6, 4.667, -4.667, 6, -3.333, 7.333, -2, 8.667, -0.667,
     10},
    {7.4, -0.9, 6.5, -1.8, 5.5, -2.7, 4.6, -3.7, 3.7, -4.6, 2.7, -5.5, 1.8, -6.5, 0.9, -7.4},
    {}};

constexpr LaserTable kHdl32eLasers{
    {-30.67, -9.33,  -29.33, -8.00,  -28.00, -6.67,  -26.67, -5.33,  -25.33, -4.00,  -24.00,
     -2.67,  -22.67, -1.33,  -21.33, 0.00,   -20.00, 1.33,   -18.67, 2.67,   -17.33, 4.00,
     -16.00, 5.33,   -14.67, 6.67,   -13.33, 8.00,   -12.00, 9.33,   -10.67, 10.67},
    {17.17, 4.76,  16.27, 4.07,  15.40, 3.38,  14.54, 2.70,  13.71, 2.02, 12.89,
     1.35,  12.09, 0.67,  11.31, 0.00,  10.54, -0.67, 9.78,  -1.35, 9.04, -2.02,
     8.30,  -2.70, 7.58,  -3.38, 6.86,  -4.07, 6.15,  -4.76, 5.45,  -5.45},
    {}};

/// The VLP-32C's manual gives no heights; other decoders take it that its beams cross 42.4 mm from
/// the axis, as those of the other models do at their distances: -42.4 mm tan(elevation).
constexpr LaserTable kVlp32cLasers{
    {-25.0,  -1.0,   -1.667, -15.639, -11.31, 0.0,    -0.667, -8.843, -7.254, 0.333,  -0.333,
     -6.148, -5.333, 1.333,  0.667,   -4.0,   -4.667, 1.667,  1.0,    -3.667, -3.333, 3.333,
     2.333,  -2.667, -3.0,   7.0,     4.667,  -2.333, -2.0,   15.0,   10.333, -1.333},
    {19.77, 0.74, 1.23,  11.87, 8.48,  0.00, 0.49,  6.60,   5.40,  -0.25, 0.25,
     4.57,  3.96, -0.99, -0.49, 2.96,  3.46, -1.23, -0.74,  2.72,  2.47,  -2.47,
     -1.73, 1.98, 2.22,  -5.21, -3.46, 1.73, 1.48,  -11.36, -7.73, 0.99},
    {1.4, -4.2, 1.4, -1.4, 1.4, -1.4, 4.2, -1.4, 1.4, -4.2, 1.4, -1.4, 4.2, -1.4, 4.2, -1.4,
     1.4, -4.2, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4, 1.4, -1.4, 1.4, -4.2, 4.2, -1.4, 1.4, -1.4}};

struct Timing {
  std::int32_t firing_ns;
  std::int32_t shot_ns;
  /// Lasers that fire at once.
  std::size_t at_once;
};

VelodyneGeometry MakeGeometry(const char* name, std::size_t lasers, float distance_unit_m,
                              const Timing& timing, const LaserTable& table) {
  VelodyneGeometry geometry;
  geometry.name = name;
  geometry.lasers = lasers;
  geometry.distance_unit_m = distance_unit_m;
  const std::size_t firings = VelodyneGeometry::kSlots / lasers;
  geometry.block_ns = static_cast<std::int32_t>(firings) * timing.firing_ns;
  const auto end = table.elevation_deg.begin() + static_cast<std::ptrdiff_t>(lasers);
  for (std::size_t slot = 0; slot < VelodyneGeometry::kSlots; ++slot) {
    const std::size_t laser = slot % lasers;
    const double elevation_rad = table.elevation_deg[laser] * kDegree;
    geometry.after_block_ns[slot] =
        static_cast<std::int32_t>(slot / lasers) * timing.firing_ns +
        static_cast<std::int32_t>(laser / timing.at_once) * timing.shot_ns;
    geometry.cos_elevation[slot] = static_cast<float>(std::cos(elevation_rad));
    geometry.sin_elevation[slot] = static_cast<float>(std::sin(elevation_rad));
    geometry.up_m[slot] = static_cast<float>(table.up_mm[laser] * 1e-3);
    geometry.azimuth_offset_rad[slot] = table.azimuth_offset_deg[laser] * kDegree;
    geometry.ring[slot] = static_cast<std::uint16_t>(
        std::count_if(table.elevation_deg.begin(), end,
                      [&](double other) { return other < table.elevation_deg[laser]; }));
  }
  return geometry;
}

}  // namespace

const VelodyneGeometry& GeometryOf(VelodyneModel model) {
  static const VelodyneGeometry vlp16 =
      MakeGeometry("VLP-16", 16, 0.002F, {55296, 2304, 1}, kVlp16Lasers);
  static const VelodyneGeometry puck_hi_res =
      MakeGeometry("Puck Hi-Res", 16, 0.002F, {55296, 2304, 1}, kPuckHiResLasers);
  static const VelodyneGeometry hdl32e =
      MakeGeometry("HDL-32E", 32, 0.002F, {46080, 1152, 1}, kHdl32eLasers);
  static const VelodyneGeometry vlp32c =
      MakeGeometry("VLP-32C", 32, 0.004F, {55296, 2304, 2}, kVlp32cLasers);
  switch (model) {
    case VelodyneModel::kPuckHiRes:
      return puck_hi_res;
    case VelodyneModel::kHdl32e:
      return hdl32e;
    case VelodyneModel::kVlp32c:
      return vlp32c;
    default:
      return vlp16;
  }
}

std::optional<VelodyneModel> VelodyneModelOf(std::uint8_t product_id) {
  switch (product_id) {
    case 0x21:
      return VelodyneModel::kHdl32e;
    case 0x22:
      return VelodyneModel::kVlp16;
    case 0x24:
      return VelodyneModel::kPuckHiRes;
    case 0x28:
      return VelodyneModel::kVlp32c;
    default:
      return {};
  }
}

}  // namespace trajlo
