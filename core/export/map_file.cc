// SPDX-License-Identifier: MIT
#include "core/export/map_file.h"

#include <cstring>
#include <string_view>

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/io/point_cloud_writer.h"
#include "core/io/point_table.h"

namespace trajlo {
namespace {

struct Row {
  float x, y, z, intensity, normal_x, normal_y, normal_z, curvature;
};
static_assert(sizeof(Row) == 8 * sizeof(float), "rows are written as they lie in memory");

Row RowOf(const Surfel& surfel) {
  const Eigen::Vector3f p = surfel.p_world_m.cast<float>();
  const Eigen::Vector3f& n = surfel.normal;
  return {p.x(), p.y(), p.z(), surfel.intensity, n.x(), n.y(), n.z(), surfel.curvature};
}

std::string PlyHeader(std::size_t count) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) + "\n";
  for (const char* name : {"x", "y", "z", "intensity", "nx", "ny", "nz", "curvature"}) {
    header += std::string("property float ") + name + "\n";
  }
  for (const char* name : {"red", "green", "blue"}) {
    header += std::string("property uchar ") + name + "\n";
  }
  return header + "end_header\n";
}

/// As PCL packs it: blue in the lowest byte.
void AppendColor(const Rgb& color, bool is_pcd, std::string* out) {
  if (is_pcd) {
    const char packed[4] = {static_cast<char>(color[2]), static_cast<char>(color[1]),
                            static_cast<char>(color[0]), 0};
    out->append(packed, 4);
  } else {
    out->append(reinterpret_cast<const char*>(color.data()), color.size());
  }
}

}  // namespace

std::vector<std::string> MapFields() {
  return {"x", "y", "z", "intensity", "normal_x", "normal_y", "normal_z", "curvature"};
}

std::vector<float> MapValues(const std::vector<Surfel>& surfels) {
  constexpr std::size_t kColumns = sizeof(Row) / sizeof(float);
  std::vector<float> values(kColumns * surfels.size());
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Row row = RowOf(surfels[i]);
    std::memcpy(&values[kColumns * i], &row, sizeof(row));
  }
  return values;
}

void WriteMapFile(const std::filesystem::path& path, const std::vector<Surfel>& surfels,
                  const std::vector<Rgb>& colors, IfExists if_exists) {
  const std::string extension = NormalisedFieldName(path.extension().string());
  const bool is_pcd = extension == ".pcd";
  if (!is_pcd && extension != ".ply") {
    throw OutputError(path, "a map is written as .pcd or .ply");
  }
  AtomicFile file(path, if_exists);
  std::string block = is_pcd ? PcdHeader("x y z intensity normal_x normal_y normal_z curvature rgb",
                                         "FFFFFFFFU", surfels.size())
                             : PlyHeader(surfels.size());
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Row row = RowOf(surfels[i]);
    block.append(reinterpret_cast<const char*>(&row), sizeof(row));
    AppendColor(colors.at(i), is_pcd, &block);
    if (block.size() < (1U << 20)) continue;
    file.Write(block);
    block.clear();
  }
  file.Write(block);
  file.Commit();
}

}  // namespace trajlo
