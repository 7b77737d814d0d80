// SPDX-License-Identifier: MIT
#include "core/io/point_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "core/io/errors.h"
#include "core/io/pcd_reader.h"
#include "core/io/ply_reader.h"
#include "core/io/velodyne_payloads.h"

namespace trajlo {
namespace {

std::string Extension(const std::filesystem::path& path) {
  return NormalisedFieldName(path.extension().string());
}

/// A file without a header can only be judged by its numbers: other binary data (packets, images)
/// read as float32 is full of values that no LiDAR measures. NaN and zero are allowed.
void CheckPlausible(const std::filesystem::path& path, const PointTable& table) {
  const std::size_t checked = std::min<std::size_t>(table.count, 10000);
  std::size_t implausible = 0;
  for (const Column& column : table.columns) {
    VisitColumn(table, column, 0, checked, [&](std::size_t, auto value) {
      const double size = std::abs(static_cast<double>(value));
      implausible += size > 1e6 || (size > 0.0 && size < 1e-20) ? 1 : 0;
    });
  }
  if (10 * implausible <= checked) return;
  throw InputError(
      path,
      std::to_string(implausible) + " of the first " +
          std::to_string(checked * table.columns.size()) +
          " numbers cannot be metres or intensities",
      "A .bin scan holds float32 x y z intensity, or x y z intensity ring, and nothing else.");
}

/// True if one column of `numbers` has rings: small whole numbers, which of coordinates only zeros
/// are. A file that was cut may end within a point, and a few numbers may be spoilt.
bool HasRings(const FileBytes& bytes, std::size_t numbers, std::size_t column = 4) {
  const std::size_t row_bytes = numbers * sizeof(float);
  const std::size_t checked = std::min<std::size_t>(bytes.size() / row_bytes, 10000);
  std::size_t rings = 0, zeros = 0;
  for (std::size_t i = 0; i < checked; ++i) {
    float ring = 0.0F;
    std::memcpy(&ring, bytes.data() + i * row_bytes + column * sizeof(float), sizeof(ring));
    rings += ring >= 0.0F && ring < 256.0F && ring == std::floor(ring) ? 1 : 0;
    zeros += ring == 0.0F ? 1 : 0;
  }
  return rings > zeros && 100 * (checked - rings) <= checked;
}

/// True if of the numbers that should be intensities many are no whole ones below zero, as
/// coordinates are.
bool HasCoordinatesAsIntensity(const FileBytes& bytes) {
  constexpr std::size_t kRow = 4 * sizeof(float);
  const std::size_t checked = std::min<std::size_t>(bytes.size() / kRow, 10000);
  std::size_t negative = 0;
  for (std::size_t i = 0; i < checked; ++i) {
    float value = 0.0F;
    std::memcpy(&value, bytes.data() + i * kRow + 3 * sizeof(float), sizeof(value));
    negative += value < 0.0F && value > -1e6F && value != std::floor(value) ? 1 : 0;
  }
  return 20 * negative > checked;
}

/// "6", or "3 or 5", if the file seems to hold that many numbers a point; else empty.
std::string OtherWidth(const FileBytes& bytes, bool has_rings) {
  const auto fits = [&](std::size_t width) { return bytes.size() % (width * sizeof(float)) == 0; };
  for (const std::size_t width : {6, 7, 8}) {
    // If these are two points of four numbers, columns 4 to 6 are coordinates.
    for (std::size_t column = 4; column < std::min<std::size_t>(width, 7); ++column) {
      if (fits(width) && HasRings(bytes, width, column)) return std::to_string(width);
    }
  }
  if (has_rings || !HasCoordinatesAsIntensity(bytes)) return "";
  if (fits(3) && fits(5)) return "3 or 5";
  return fits(3) ? "3" : fits(5) ? "5" : "";
}

/// Float32 without a header: KITTI's x y z intensity, or with a ring behind them.
PointTable ReadBin(const std::filesystem::path& path, FileBytes bytes) {
  if (BeginsAsVelodynePayloads(bytes.view())) {
    throw InputError(path, "these are packets of a Velodyne, not the points of a scan",
                     "Give the file itself in place of its folder.");
  }
  std::vector<const char*> names = {"x", "y", "z", "intensity"};
  if (HasRings(bytes, 5)) names.push_back("ring");
  const std::size_t row_bytes = names.size() * sizeof(float);
  PointTable table;
  table.count = bytes.size() / row_bytes;
  if (bytes.size() % row_bytes != 0) {
    table.damage = std::to_string(bytes.size()) + " bytes are " + std::to_string(table.count) +
                   " points of " + std::to_string(row_bytes) + " bytes and a rest of " +
                   std::to_string(bytes.size() % row_bytes);
  }
  std::size_t offset = 0;
  for (const char* name : names) {
    table.columns.push_back({name, ScalarType::kFloat32, offset, row_bytes, false});
    offset += sizeof(float);
  }
  table.bytes = std::move(bytes);
  CheckPlausible(path, table);
  const std::string width = OtherWidth(table.bytes, names.size() == 5);
  if (width.empty()) return table;
  throw InputError(path, "this seems to hold " + width + " numbers a point",
                   "A .bin scan holds float32 x y z intensity, or x y z intensity ring. Write "
                   "such a file, or a .pcd with the names of its fields.");
}

}  // namespace

bool IsPointFile(const std::filesystem::path& path) {
  const std::string extension = Extension(path);
  return extension == ".pcd" || extension == ".ply" || extension == ".bin";
}

PointTable ReadPointFile(const std::filesystem::path& path) {
  const std::string extension = Extension(path);
  if (extension == ".pcd") return ReadPcd(path, ReadFileBytes(path));
  if (extension == ".ply") return ReadPly(path, ReadFileBytes(path));
  if (extension == ".bin") return ReadBin(path, ReadFileBytes(path));
  throw InputError(path, "unknown kind of point file", "Supported are .pcd, .ply and .bin.");
}

}  // namespace trajlo
