// SPDX-License-Identifier: MIT
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <array>
#include <string>

#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/python/module/errors.h"
#include "apps/python/module/inspected_window.h"
#include "apps/python/module/values.h"
#include "core/config/config_error.h"

namespace trajlo::python {
namespace {

/// One number of each point, (N,).
template <typename T, typename Get>
py::array_t<T> Column(const WindowGraph& graph, const Get& get) {
  py::array_t<T> array(static_cast<py::ssize_t>(graph.points.size()));
  T* out = array.mutable_data();
  for (const PointFactor& factor : graph.points) *out++ = static_cast<T>(get(factor));
  return array;
}

/// One vector of each point, (N, 3).
template <typename Get>
py::array_t<double> Vectors(const WindowGraph& graph, const Get& get) {
  py::array_t<double> array({static_cast<py::ssize_t>(graph.points.size()), py::ssize_t{3}});
  double* out = array.mutable_data();
  for (const PointFactor& factor : graph.points) {
    const Eigen::Vector3d vector = get(factor);
    out = std::copy_n(vector.data(), 3, out);
  }
  return array;
}

py::dict Points(const InspectedWindow& inspected) {
  const WindowGraph& graph = inspected.graph();
  using Factor = const PointFactor&;
  py::dict points;
  points["segment"] = Column<std::int64_t>(graph, [](Factor f) { return f.segment; });
  points["t_ns"] = Column<std::int64_t>(graph, [](Factor f) { return f.t_ns; });
  points["alpha"] = Column<double>(graph, [](Factor f) { return f.point.alpha; });
  points["lidar"] = Column<std::int64_t>(graph, [](Factor f) { return f.point.lidar; });
  points["p_body"] = Vectors(graph, [](Factor f) { return f.point.p_body_m; });
  points["p_world"] = Vectors(graph, [](Factor f) { return f.x_world; });
  points["normal_world"] = Vectors(graph, [](Factor f) { return f.point.normal_world; });
  points["offset_m"] = Column<double>(graph, [](Factor f) { return f.point.offset_m; });
  points["distance_m"] = Column<double>(graph, [](Factor f) { return f.distance_m; });
  points["weight"] = Column<double>(graph, [](Factor f) { return f.point.weight; });
  points["kernel_weight"] = Column<double>(graph, [](Factor f) { return f.kernel_weight; });
  points["information"] = Column<double>(graph, [](Factor f) { return f.information; });
  return points;
}

py::list Segments(const InspectedWindow& inspected) {
  py::list segments;
  for (int k = 0; k < inspected.window().size(); ++k) {
    const SegmentFactors& factors = inspected.graph().segments[static_cast<std::size_t>(k)];
    py::dict segment;
    segment["points"] = factors.points;
    segment["sigma_m"] = factors.sigma_m;
    segment["kernel_m"] = factors.kernel_m;
    segment["noise_factor"] = inspected.window().At(k).noise_factor;
    segment["cost"] = factors.registration.cost;
    segments.append(segment);
  }
  return segments;
}

py::list Motion(const InspectedWindow& inspected) {
  py::list terms;
  for (const LinearizedMotion& motion : inspected.graph().motion) {
    if (motion.count == 0) continue;
    py::dict term;
    term["first_pose"] = motion.first;
    term["residual"] = motion.residual;
    term["jacobian"] = Eigen::MatrixXd(motion.jacobian.leftCols(6 * motion.count));
    terms.append(term);
  }
  return terms;
}

py::dict Prior(const InspectedWindow& inspected) {
  const MarginalizationPrior& prior = inspected.window().prior;
  py::dict dict;
  dict["linearization_points"] = PoseArray(prior.linearization_points);
  dict["sqrt_information"] = prior.sqrt_information;
  dict["offset"] = prior.offset;
  dict["residual"] = inspected.graph().prior.residual;
  dict["jacobian"] = inspected.graph().prior.jacobian;
  return dict;
}

py::dict Cost(const InspectedWindow& inspected) {
  const WindowCost& cost = inspected.graph().equations.cost;
  py::dict dict;
  dict["registration"] = cost.registration;
  dict["motion"] = cost.motion;
  dict["prior"] = cost.prior;
  return dict;
}

py::array_t<std::int64_t> Times(const InspectedWindow& inspected) {
  std::vector<std::int64_t> times = {inspected.window().begin_ns};
  for (const Segment& segment : inspected.window().segments) times.push_back(segment.cloud.end_ns);
  return CopyOf(times);
}

/// A choice by the name that it has in the configuration. Messages name the argument, not the key.
RunConfig With(RunConfig config, const char* argument, const std::string& key,
               const std::optional<std::string>& name) {
  if (!name) return config;
  try {
    ApplyOverrides(key + "=" + *name, &config, argument);
  } catch (const ConfigError& error) {
    std::string message = error.what();
    const std::string quoted = "'" + key + "' ";
    const std::size_t at = message.find(quoted);
    if (at != std::string::npos) message.erase(at, quoted.size());
    throw ConfigError(message);
  }
  return config;
}

InspectedWindow Solve(const InspectedWindow& inspected, const py::object& sigma_m,
                      const py::object& kernel, const py::object& kernel_m,
                      const py::object& translation_m2_s3, const py::object& rotation_rad2_s3,
                      const py::object& prior_factor, const py::object& point_weights,
                      const py::object& solver, const py::object& max_iterations,
                      const py::kwargs& unknown) {
  RefuseUnknown(unknown, "solve()",
                {"sigma_m", "kernel", "kernel_m", "translation_m2_s3", "rotation_rad2_s3",
                 "prior_factor", "point_weights", "solver", "max_iterations"});
  Reweighing reweighing;
  reweighing.sigma_m = ReadReal(sigma_m, "sigma_m");
  reweighing.kernel_m = ReadReal(kernel_m, "kernel_m");
  reweighing.translation_m2_s3 = ReadReal(translation_m2_s3, "translation_m2_s3");
  reweighing.rotation_rad2_s3 = ReadReal(rotation_rad2_s3, "rotation_rad2_s3");
  reweighing.prior_factor = ReadReal(prior_factor, "prior_factor");
  if (const auto name = ReadText(kernel, "kernel")) {
    reweighing.kernel = With(inspected.config(), "kernel", "expert.registration.kernel", name)
                            .odometry.registration.kernel;
  }
  if (!point_weights.is_none()) {
    reweighing.point_weights = ReadReals(point_weights, "point_weights");
    if (reweighing.point_weights.size() != inspected.graph().points.size()) {
      throw DataError("point_weights: there are " +
                      std::to_string(reweighing.point_weights.size()) + " for " +
                      std::to_string(inspected.graph().points.size()) + " points");
    }
  }
  const int most_iterations = ReadWhole(max_iterations, "max_iterations");
  if (most_iterations < 1 || most_iterations > 1'000'000) {
    throw DataError("max_iterations: must be from 1 to 1000000");
  }
  const SolverKind kind =
      With(inspected.config(), "solver", "solver.kind", ReadText(solver, "solver"))
          .odometry.solver.kind;
  try {
    const py::gil_scoped_release release;
    return inspected.Solve(reweighing, kind, most_iterations);
  } catch (const std::invalid_argument& error) {
    throw DataError(error.what());
  }
}

constexpr char kAbout[] =
    R"(A window as it was solved: every factor, what they add up to, and how it would be otherwise.

Comes from Odometry(on_solved=...). Poses are T_world_body; perturbations are [rho; theta] on the
right of each pose, m and rad, in the order of the poses. All numbers are evaluated at `poses`.)";

constexpr char kSolveAbout[] =
    R"(The same window, solved from its poses with other weights: a new Window.

Its points keep their planes. What is not given stays as it was in the run.

sigma_m            of a point (here: registration.sigma_m times the root of points_per_error)
kernel, kernel_m   robust kernel by name, and its width in all directions
translation_m2_s3, rotation_rad2_s3   spectral densities of the motion prior
prior_factor       of the information of the marginalisation prior; 0 leaves it out
point_weights      (N,), in the order of `points`; 0 leaves a point out
solver             "ceres" or "gauss_newton"
max_iterations     it ends before that when the steps are below 1e-9 m and 1e-10 rad

Raises TypeError for a value of another type, InputError, ConfigError, and EstimatorError where there
is no finite solution.)";

}  // namespace

void BindWindow(py::module_* module) {
  py::class_<InspectedWindow>(*module, "Window", kAbout)
      .def_property_readonly("index", &InspectedWindow::index, "Its row of windows.csv.")
      .def_property_readonly("times_ns", &Times, "(K+1,) int64: when its poses are.")
      .def_property_readonly(
          "poses", [](const InspectedWindow& w) { return PoseArray(w.window().Poses()); },
          "(K+1, 4, 4): T_world_body.")
      .def_property_readonly("points", &Points, R"(The registration, a dict of arrays with N rows:

segment (between poses segment and segment + 1), t_ns, alpha (its share of the segment), lidar;
p_body, p_world, normal_world (N, 3), offset_m: the plane is normal . x = offset;
distance_m, weight, kernel_weight, and information = weight kernel_weight / sigma_m² (1/m²).)")
      .def_property_readonly("segments", &Segments,
                             "A dict each: points, sigma_m, kernel_m (3,), noise_factor, cost.")
      .def_property_readonly("motion", &Motion,
                             "A dict for each term: first_pose, residual (6,), jacobian (6, 6n).")
      .def_property_readonly("prior", &Prior, R"(The marginalisation prior on the first n poses:

residual = sqrt_information d + offset, d = pose ⊖ linearization_points; and its jacobian.)")
      .def_property_readonly(
          "H", [](const InspectedWindow& w) { return w.graph().equations.H; },
          "(6K+6, 6K+6): the information of all factors.")
      .def_property_readonly(
          "g", [](const InspectedWindow& w) { return w.graph().equations.g; },
          "(6K+6,): the gradient of the cost.")
      .def_property_readonly("cost", &Cost,
                             "Halves of squared residuals: registration, motion, prior.")
      .def_property_readonly(
          "costs", [](const InspectedWindow& w) { return w.summary().costs; },
          "After solve(): the whole cost at the start and after each step. Gauss-Newton does not\n"
          "compute that of its last one.")
      .def_property_readonly(
          "iterations", [](const InspectedWindow& w) { return w.summary().iterations; },
          "After solve(): the steps that were taken; max_iterations of them may be too few.")
      .def_property_readonly(
          "sigma_m", [](const InspectedWindow& w) { return w.window().noise.sigma_m; },
          "Of a point, before noise_factor and the bend of its segment: see solve().")
      .def("solve", &Solve, py::kw_only(), py::arg("sigma_m") = py::none(),
           py::arg("kernel") = py::none(), py::arg("kernel_m") = py::none(),
           py::arg("translation_m2_s3") = py::none(), py::arg("rotation_rad2_s3") = py::none(),
           py::arg("prior_factor") = py::none(), py::arg("point_weights") = py::none(),
           py::arg("solver") = py::none(), py::arg("max_iterations") = 100, kSolveAbout)
      .def("__repr__", [](const InspectedWindow& w) {
        return "trajlo.Window(index=" + std::to_string(w.index()) + ", " +
               std::to_string(w.window().size()) + " segments, " +
               std::to_string(w.graph().points.size()) + " points)";
      });
}

}  // namespace trajlo::python
