// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace trajlo {

/// The Velodyne sensors whose geometry is the same for every unit.
enum class VelodyneModel { kVlp16, kPuckHiRes, kHdl32e, kVlp32c };

/// By the names that options take.
inline constexpr std::pair<const char*, VelodyneModel> kVelodyneModels[] = {
    {"VLP-16", VelodyneModel::kVlp16},
    {"Puck-Hi-Res", VelodyneModel::kPuckHiRes},
    {"HDL-32E", VelodyneModel::kHdl32e},
    {"VLP-32C", VelodyneModel::kVlp32c}};

/// Where and when the 32 measurements of a data block were taken: slot k of a block is laser
/// k % lasers of firing k / lasers. Sources: the user manuals 63-9243 (VLP-16, Puck LITE, Puck
/// Hi-Res), 63-9113 (HDL-32E; its lasers' heights from the drawing 86-0106) and 63-9325 (VLP-32C).
struct VelodyneGeometry {
  static constexpr std::size_t kSlots = 32;

  const char* name = "";
  std::size_t lasers = 0;
  /// m of one unit of distance.
  float distance_unit_m = 0.0F;
  /// From the first laser of a block to the first one of the next.
  std::int32_t block_ns = 0;
  std::array<std::int32_t, kSlots> after_block_ns{};
  std::array<float, kSlots> cos_elevation{};
  std::array<float, kSlots> sin_elevation{};
  /// Added to z: the lasers of one column do not start from one point.
  std::array<float, kSlots> up_m{};
  /// Added to the block's azimuth.
  std::array<double, kSlots> azimuth_offset_rad{};
  /// 0 is the lowest beam.
  std::array<std::uint16_t, kSlots> ring{};
};

const VelodyneGeometry& GeometryOf(VelodyneModel model);

/// The model that the second factory byte of a packet names; none if it is not supported.
std::optional<VelodyneModel> VelodyneModelOf(std::uint8_t product_id);

}  // namespace trajlo
