// SPDX-License-Identifier: MIT
#include "core/graph/graph_files.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/io/atomic_file.h"
#include "core/io/errors.h"
#include "core/odometry/weights/registration_options.h"

namespace trajlo {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A row each; a column vector is a list.
template <typename Derived>
Json ToJson(const Eigen::MatrixBase<Derived>& matrix) {
  Json json = Json::array();
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    if constexpr (Derived::ColsAtCompileTime == 1) {
      json.push_back(matrix(row, 0));
    } else {
      Json columns = Json::array();
      for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
        columns.push_back(matrix(row, column));
      }
      json.push_back(columns);
    }
  }
  return json;
}

/// x y z qx qy qz qw, as in a TUM file.
Json ToJson(const SE3& T) {
  return {T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w()};
}

Json ToJson(const std::vector<SE3>& poses) {
  Json json = Json::array();
  for (const SE3& T : poses) json.push_back(ToJson(T));
  return json;
}

std::string NameOf(KernelKind kind) {
  for (const auto& [name, value] : KernelNames()) {
    if (value == kind) return name;
  }
  return "";
}

Json TimesJson(const Window& window) {
  Json times = {window.begin_ns};
  for (const Segment& segment : window.segments) times.push_back(segment.cloud.end_ns);
  return times;
}

Json SegmentsJson(const Window& window, const WindowGraph& graph) {
  Json json = Json::array();
  for (int k = 0; k < window.size(); ++k) {
    const Segment& segment = window.At(k);
    const SegmentFactors& factors = graph.segments[static_cast<std::size_t>(k)];
    json.push_back({{"registration_points", segment.cloud.registration_points.size()},
                    {"points", factors.points},
                    {"sigma_m", factors.sigma_m},
                    {"kernel_m", factors.kernel_m},
                    {"noise_factor", segment.noise_factor},
                    {"bend_m2", segment.bend_m2},
                    {"cost", factors.registration.cost}});
  }
  return json;
}

Json MotionJson(const Window& window, const WindowGraph& graph) {
  Json json = Json::array();
  for (int k = 0; k < window.size(); ++k) {
    const LinearizedMotion& motion = graph.motion[static_cast<std::size_t>(k)];
    if (motion.count == 0) continue;
    Json term = {{"segment", k}, {"first_pose", motion.first}, {"poses", motion.count}};
    if (const auto* free = std::get_if<WhiteNoiseAccelerationTerm>(&window.At(k).motion)) {
      term["kind"] = "white_noise_acceleration";
      term["sqrt_information"] = ToJson(free->sqrt_information);
      term["persistence"] = ToJson(free->persistence);
      term["mean_velocity"] = ToJson(free->mean_velocity);
    } else if (const auto* known = std::get_if<SmoothnessTerm>(&window.At(k).motion)) {
      term["kind"] = "known_velocity";
      term["sqrt_information"] = ToJson(known->sqrt_information);
      term["tau_expected"] = ToJson(known->tau_expected);
    }
    term["residual"] = ToJson(motion.residual);
    term["jacobian"] = ToJson(motion.jacobian.leftCols(6 * motion.count));
    json.push_back(term);
  }
  return json;
}

Json GraphJson(std::int64_t index, const Window& window, const WindowGraph& graph) {
  const WindowCost& cost = graph.equations.cost;
  return {{"index", index},
          {"points", GraphName(index) + ".ply"},
          {"times_ns", TimesJson(window)},
          {"poses", ToJson(window.Poses())},
          {"is_believed", window.is_believed},
          {"cost",
           {{"registration", cost.registration}, {"motion", cost.motion}, {"prior", cost.prior}}},
          {"kernel", NameOf(window.noise.kernel.kind)},
          {"kernel_axes_world", ToJson(window.kernel_axes)},
          {"segments", SegmentsJson(window, graph)},
          {"motion", MotionJson(window, graph)},
          {"prior",
           {{"linearization_points", ToJson(window.prior.linearization_points)},
            {"sqrt_information", ToJson(window.prior.sqrt_information)},
            {"offset", ToJson(window.prior.offset)},
            {"residual", ToJson(graph.prior.residual)},
            {"jacobian", ToJson(graph.prior.jacobian)}}},
          {"H", ToJson(graph.equations.H)},
          {"g", ToJson(graph.equations.g)}};
}

constexpr std::array kPointFields = {"x",
                                     "y",
                                     "z",
                                     "nx",
                                     "ny",
                                     "nz",
                                     "distance_m",
                                     "weight",
                                     "kernel_weight",
                                     "information",
                                     "segment",
                                     "alpha",
                                     "lidar",
                                     "axis",
                                     "p_body_x",
                                     "p_body_y",
                                     "p_body_z",
                                     "offset_m",
                                     "coarseness",
                                     "normal_variance_rad2"};

std::array<double, kPointFields.size()> Row(const PointFactor& factor) {
  const RegistrationPoint& point = factor.point;
  const Eigen::Vector3d &x = factor.x_world, &n = point.normal_world, &p = point.p_body_m;
  return {x.x(),
          x.y(),
          x.z(),
          n.x(),
          n.y(),
          n.z(),
          factor.distance_m,
          point.weight,
          factor.kernel_weight,
          factor.information,
          static_cast<double>(factor.segment),
          point.alpha,
          static_cast<double>(point.lidar),
          static_cast<double>(point.axis),
          p.x(),
          p.y(),
          p.z(),
          point.offset_m,
          point.coarseness,
          point.normal_variance_rad2};
}

void WritePoints(const fs::path& path, const std::vector<PointFactor>& points) {
  std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string(points.size()) + "\n";
  for (const char* field : kPointFields) header += std::string("property double ") + field + "\n";
  AtomicFile file(path, IfExists::kReplace);
  file.Write(header + "end_header\n");
  std::vector<std::array<double, kPointFields.size()>> rows;
  rows.reserve(points.size());
  for (const PointFactor& factor : points) rows.push_back(Row(factor));
  file.Write(std::string_view(reinterpret_cast<const char*>(rows.data()),
                              rows.size() * sizeof(rows.front())));
  file.Commit();
}

}  // namespace

std::string GraphName(std::int64_t index) {
  const std::string digits = std::to_string(index);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

void WriteGraphFiles(const fs::path& folder, std::int64_t index, const Window& window) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(folder, "the folder cannot be created: " + error.message());
  const WindowGraph graph = MakeWindowGraph(window);
  const fs::path name = folder / GraphName(index);
  WritePoints(fs::path(name) += ".ply", graph.points);
  WriteTextFile(fs::path(name) += ".json", GraphJson(index, window, graph).dump(1) + "\n",
                IfExists::kReplace);
}

}  // namespace trajlo
