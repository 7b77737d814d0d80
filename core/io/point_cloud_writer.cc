// SPDX-License-Identifier: MIT
#include "core/io/point_cloud_writer.h"

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/point_table.h"

namespace trajlo {
namespace {

static_assert(sizeof(CloudPoint) == 4 * sizeof(float), "points are written as they lie in memory");

std::string PlyHeader(std::size_t count, bool intensity) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
         "\nproperty float x\nproperty float y\nproperty float z\n" +
         (intensity ? "property float intensity\n" : "") + "end_header\n";
}

std::string_view BytesOf(const CloudPoint* points, std::size_t count) {
  return {reinterpret_cast<const char*>(points), count * sizeof(CloudPoint)};
}

}  // namespace

void WritePointCloud(const std::filesystem::path& path, const std::vector<CloudPoint>& points,
                     CloudFields fields, IfExists if_exists) {
  const bool intensity = fields == CloudFields::kXyzIntensity;
  const std::string extension = NormalisedFieldName(path.extension().string());
  if (extension != ".pcd" && extension != ".ply") {
    throw OutputError(path, "a point cloud is written as .pcd or .ply");
  }
  AtomicFile file(path, if_exists);
  if (extension == ".ply") {
    file.Write(PlyHeader(points.size(), intensity));
  } else {
    file.Write(intensity ? PcdHeader("x y z intensity", "FFFF", points.size())
                         : PcdHeader("x y z", "FFF", points.size()));
  }
  if (intensity) {
    file.Write(BytesOf(points.data(), points.size()));
  } else {
    std::string block;
    for (const CloudPoint& point : points) {
      block.append(BytesOf(&point, 1).substr(0, 3 * sizeof(float)));
      if (block.size() < (1U << 16)) continue;
      file.Write(block);
      block.clear();
    }
    file.Write(block);
  }
  file.Commit();
}

std::string PcdHeader(const std::string& fields, std::string_view types, std::size_t count) {
  std::string size_words, type_words, count_words;
  for (const char type : types) {
    size_words += " 4";
    type_words += {' ', type};
    count_words += " 1";
  }
  const std::string n = std::to_string(count);
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE" +
         size_words + "\nTYPE" + type_words + "\nCOUNT" + count_words + "\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA binary\n";
}

}  // namespace trajlo
