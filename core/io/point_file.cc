// SPDX-License-Identifier: MIT
#include "core/io/point_file.h"

#include <algorithm>
#include <cmath>

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
  throw InputError(path,
                   std::to_string(implausible) + " of the first " +
                       std::to_string(checked * table.columns.size()) +
                       " numbers cannot be metres or intensities",
                   "A .bin scan holds float32 x y z intensity and nothing else.");
}

PointTable ReadKittiBin(const std::filesystem::path& path, FileBytes bytes) {
  if (BeginsAsVelodynePayloads(bytes.view())) {
    throw InputError(path, "these are packets of a Velodyne, not the points of a scan",
                     "Give the file itself in place of its folder.");
  }
  constexpr std::size_t kRowBytes = 4 * sizeof(float);
  PointTable table;
  table.count = bytes.size() / kRowBytes;
  if (bytes.size() % kRowBytes != 0) {
    table.damage = std::to_string(bytes.size()) + " bytes are " + std::to_string(table.count) +
                   " points of 16 bytes and a rest of " + std::to_string(bytes.size() % kRowBytes);
  }
  std::size_t offset = 0;
  for (const char* name : {"x", "y", "z", "intensity"}) {
    table.columns.push_back({name, ScalarType::kFloat32, offset, kRowBytes, false});
    offset += sizeof(float);
  }
  table.bytes = std::move(bytes);
  CheckPlausible(path, table);
  return table;
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
  if (extension == ".bin") return ReadKittiBin(path, ReadFileBytes(path));
  throw InputError(path, "unknown kind of point file", "Supported are .pcd, .ply and .bin.");
}

}  // namespace trajlo
