// SPDX-License-Identifier: MIT
#include "core/simulation/scene_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/io/format_text.h"

namespace trajlo::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Segment = std::pair<Vector2d, Vector2d>;

std::vector<Segment> Slice(const TriangleMesh& mesh, double z) {
  std::vector<Segment> segments;
  for (const auto& triangle : mesh.triangles) {
    std::vector<Vector2d> ends;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d a = mesh.vertices[triangle[i]].cast<double>();
      const Vector3d b = mesh.vertices[triangle[(i + 1) % 3]].cast<double>();
      if ((a.z() < z) == (b.z() < z)) continue;
      const double f = (z - a.z()) / (b.z() - a.z());
      ends.emplace_back((a + f * (b - a)).head<2>());
    }
    if (ends.size() == 2) segments.emplace_back(ends[0], ends[1]);
  }
  return segments;
}

std::vector<Vector3d> Path(const Simulator& simulator) {
  constexpr std::int64_t kStepNs = 50'000'000;
  std::vector<Vector3d> path;
  for (std::int64_t t = simulator.start_ns(); t <= simulator.end_ns(); t += kStepNs) {
    path.push_back(simulator.TrueWorldFromBody(t).t);
  }
  return path;
}

/// Maps the world to the picture: y up becomes y down.
struct View {
  Vector2d low, high;
  double pixels_per_metre;

  std::string Point(const Vector2d& p, const char* separator) const {
    return FormatText("%.1f%s%.1f", (p.x() - low.x()) * pixels_per_metre, separator,
                      (high.y() - p.y()) * pixels_per_metre);
  }
  bool Shows(const Segment& s) const {
    const Vector2d a = s.first.cwiseMax(s.second);
    const Vector2d b = s.first.cwiseMin(s.second);
    return (a.array() >= low.array()).all() && (b.array() <= high.array()).all();
  }
};

std::string SlicePath(const std::vector<Segment>& segments, const View& view, const char* style) {
  std::string d;
  for (const Segment& s : segments) {
    if (view.Shows(s)) d += "M" + view.Point(s.first, " ") + "L" + view.Point(s.second, " ");
  }
  return R"(<path d=")" + d + R"(" fill="none" )" + style + "/>\n";
}

}  // namespace

std::string ScenePicture(const Simulator& simulator) {
  constexpr double kWidthPixels = 1000.0;
  constexpr double kMargin = 30.0;  // Of scene around the path.
  const std::vector<Vector3d> path = Path(simulator);
  Vector3d low = path.front();
  Vector3d high = path.front();
  double mean_z = 0.0;
  for (const Vector3d& p : path) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    mean_z += p.z() / static_cast<double>(path.size());
  }
  View view{low.head<2>().array() - kMargin, high.head<2>().array() + kMargin, 1.0};
  view.pixels_per_metre = kWidthPixels / (view.high - view.low).x();
  const double height_pixels = view.pixels_per_metre * (view.high - view.low).y();

  std::string svg = FormatText(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\">\n"
      "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
      kWidthPixels, height_pixels);
  const TriangleMesh& mesh = simulator.scene().mesh();
  svg += SlicePath(Slice(mesh, low.z() + 0.2), view, R"(stroke="#c0c8d0" stroke-width="1.5")");
  svg += SlicePath(Slice(mesh, mean_z), view, R"(stroke="#404850" stroke-width="1.5")");
  std::string points;
  for (const Vector3d& p : path) points += view.Point(p.head<2>(), ",") + " ";
  svg += "<polyline points=\"" + points +
         "\" fill=\"none\" stroke=\"#d62728\" stroke-width=\"2.5\"/>\n";
  const std::string start = view.Point(path.front().head<2>(), "\" cy=\"");
  svg += "<circle cx=\"" + start + "\" r=\"6\" fill=\"#d62728\"/>\n";

  const double scale_m = std::pow(10.0, std::floor(std::log10((view.high - view.low).x() / 4.0)));
  const double y = height_pixels - 20.0;
  svg += FormatText(
      "<path d=\"M20 %.0fh%.1f\" stroke=\"black\" stroke-width=\"3\"/>\n"
      "<text x=\"20\" y=\"%.0f\" font-family=\"sans-serif\" font-size=\"18\">%g m</text>\n",
      y, scale_m * view.pixels_per_metre, y - 8.0, scale_m);
  return svg + "</svg>\n";
}

}  // namespace trajlo::simulation
