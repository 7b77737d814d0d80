// SPDX-License-Identifier: MIT
#include "core/report/view_ply.h"

#include <string>
#include <string_view>

#include "core/io/atomic_file.h"
#include "core/io/stamp_text.h"
#include "core/scans/nanoseconds.h"

namespace trajlo {
namespace {

struct Row {
  float x, y, z, intensity, t_s;
};
static_assert(sizeof(Row) == 5 * sizeof(float), "rows are written as they lie in memory");

}  // namespace

void WriteViewPly(const std::filesystem::path& path, const std::vector<WorldPoint>& points) {
  const std::int64_t begin_ns = points.empty() ? 0 : points.front().moment_ns;
  std::vector<Row> rows;
  rows.reserve(points.size());
  for (const WorldPoint& point : points) {
    const Eigen::Vector3f& p = point.p_world_m;
    const auto t_s = static_cast<float>(Seconds(point.moment_ns - begin_ns));
    rows.push_back({p.x(), p.y(), p.z(), point.intensity, t_s});
  }
  AtomicFile file(path, IfExists::kReplace);
  file.Write("ply\nformat binary_little_endian 1.0\ncomment begin_s " + FormatSeconds(begin_ns) +
             "\nelement vertex " + std::to_string(rows.size()) +
             "\nproperty float x\nproperty float y\nproperty float z\nproperty float intensity"
             "\nproperty float t_s\nend_header\n");
  file.Write(
      std::string_view(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)));
  file.Commit();
}

}  // namespace trajlo
