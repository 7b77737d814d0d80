// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/python/module/arrays.h"
#include "apps/python/module/bindings.h"
#include "apps/python/module/errors.h"
#include "apps/python/module/flagged_trajectory.h"
#include "apps/usage_error.h"
#include "core/io/stamp_text.h"
#include "core/io/trajectory_writer.h"
#include "core/scans/nanoseconds.h"

namespace trajlo::python {
namespace {

constexpr char kDoc[] =
    R"(A trajectory in continuous time: poses, and the constant twist between neighbours.

Poses are T_world_body: they map coordinates of the body frame to the world frame, metres.
Times are in the clock of the scans. It does not change.

Trajectory(times_ns, poses) makes one: (N,) int64, increasing, and (N, 4, 4).)";

constexpr char kAtDoc[] = R"(The poses T_world_body at any times from the first to the last.

times_s    seconds, a number or (M,); or
times_ns   nanoseconds, int or (M,), which is exact: seconds since 1970 are rounded to 0.2 us
outside    what to do about times that the trajectory does not cover: "raise" an InputError, or "nan"

Returns (4, 4) for a number and (M, 4, 4) for an array.)";

constexpr char kFlagsDoc[] =
    R"((N,) uint32: bits as in the column `flags` of windows and in flags.csv; 0 is good.

None where nothing is known: only an Odometry sets them, and read_trajectory() finds those of a
result folder.)";

constexpr char kSampleDoc[] =
    R"(A trajectory of the poses at these times, which must increase. Arguments as for at().)";

/// The year 2116: differences of such times fit into int64.
constexpr std::int64_t kLatest_ns = (std::int64_t{1} << 62) - 1;

std::vector<SE3> PosesOf(const Trajectory& trajectory) {
  std::vector<SE3> poses;
  poses.reserve(trajectory.poses().size());
  for (const ControlPose& pose : trajectory.poses()) poses.push_back(pose.T_world_body);
  return poses;
}

Trajectory Make(const std::vector<std::int64_t>& times_ns, const std::vector<SE3>& poses) {
  if (times_ns.size() != poses.size()) {
    throw DataError("times_ns: must have one element for each of the " +
                    std::to_string(poses.size()) + " poses, found " +
                    std::to_string(times_ns.size()));
  }
  Trajectory trajectory;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (times_ns[i] < -kLatest_ns || times_ns[i] > kLatest_ns) {
      throw DataError("times_ns[" + std::to_string(i) + "]: must be within ±2^62 ns, found " +
                      std::to_string(times_ns[i]));
    }
    if (i > 0 && times_ns[i] <= times_ns[i - 1]) {
      throw DataError("times_ns[" + std::to_string(i) + "]: must be after the one before, found " +
                      FormatSeconds(times_ns[i]) + " s after " + FormatSeconds(times_ns[i - 1]) +
                      " s");
    }
    trajectory.Append({times_ns[i], poses[i], 0});
  }
  return trajectory;
}

/// Seconds are rounded, so that the first and the last time may come out a little outside.
std::int64_t NsFromSeconds(double t_s, const Trajectory& trajectory) {
  constexpr double kLatest_s = 4.6e9;
  constexpr std::int64_t kRounding_ns = 1000;
  if (!(std::abs(t_s) <= kLatest_s)) {
    throw DataError("times_s: must be seconds within ±4.6e9, found " + std::to_string(t_s));
  }
  const std::int64_t t_ns = Nanoseconds(t_s);
  if (trajectory.empty()) return t_ns;
  const std::int64_t first = trajectory.poses().front().t_ns;
  const std::int64_t last = trajectory.poses().back().t_ns;
  const std::int64_t nearest = std::clamp(t_ns, first, last);
  return std::abs(t_ns - nearest) <= kRounding_ns ? nearest : t_ns;
}

struct Times {
  std::vector<std::int64_t> ns;
  bool is_scalar;
};

Times TimesFrom(const Trajectory& trajectory, const py::object& times_s,
                const py::object& times_ns) {
  if (times_s.is_none() == times_ns.is_none()) throw UsageError("give either times_s or times_ns");
  if (times_s.is_none()) return {ReadIntegers(times_ns, "times_ns"), IsScalar(times_ns)};
  RequireFineSeconds(times_s, "times_s", " or times_ns");
  Times times{{}, IsScalar(times_s)};
  for (const double t_s : ReadReals(times_s, "times_s")) {
    times.ns.push_back(NsFromSeconds(t_s, trajectory));
  }
  return times;
}

[[noreturn]] void FailOutside(const Trajectory& trajectory, std::int64_t t_ns) {
  if (trajectory.empty()) throw DataError("the trajectory is empty");
  throw DataError("the trajectory does not cover " + FormatSeconds(t_ns) + " s: it goes from " +
                  FormatSeconds(trajectory.poses().front().t_ns) + " s to " +
                  FormatSeconds(trajectory.poses().back().t_ns) +
                  " s (outside=\"nan\" gives NaN in place of this error)");
}

SE3 NoPose() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  SE3 pose;
  pose.q.coeffs().setConstant(kNaN);
  pose.t.setConstant(kNaN);
  return pose;
}

py::array_t<double> At(const FlaggedTrajectory& trajectory, const py::object& times_s,
                       const py::object& times_ns, const std::string& outside,
                       const py::kwargs& unknown) {
  RefuseUnknown(unknown, "at()", {"times_s", "times_ns", "outside"});
  if (outside != "raise" && outside != "nan") {
    throw UsageError("outside: must be raise or nan, found '" + outside + "'");
  }
  const Times times = TimesFrom(trajectory, times_s, times_ns);
  std::vector<SE3> poses;
  poses.reserve(times.ns.size());
  for (const std::int64_t t_ns : times.ns) {
    const std::optional<SE3> pose = trajectory.At(t_ns);
    if (!pose && outside == "raise") FailOutside(trajectory, t_ns);
    poses.push_back(pose.value_or(NoPose()));
  }
  return times.is_scalar ? PoseArray(poses.front()) : PoseArray(poses);
}

FlaggedTrajectory Sample(const FlaggedTrajectory& trajectory, const py::object& times_s,
                         const py::object& times_ns, const py::kwargs& unknown) {
  RefuseUnknown(unknown, "sample()", {"times_s", "times_ns"});
  const Times times = TimesFrom(trajectory, times_s, times_ns);
  std::vector<SE3> poses;
  poses.reserve(times.ns.size());
  for (const std::int64_t t_ns : times.ns) {
    const std::optional<SE3> pose = trajectory.At(t_ns);
    if (!pose) FailOutside(trajectory, t_ns);
    poses.push_back(*pose);
  }
  const Trajectory sampled = Make(times.ns, poses);
  if (!trajectory.has_flags()) return FlaggedTrajectory(sampled);
  return {sampled, PoseFlags(trajectory.poses(), std::nullopt)};
}

template <typename T, typename Get>
py::array_t<T> Collect(const Trajectory& trajectory, int columns, Get get) {
  const auto count = static_cast<py::ssize_t>(trajectory.poses().size());
  py::array_t<T> array = columns == 0 ? py::array_t<T>(count)
                                      : py::array_t<T>({count, static_cast<py::ssize_t>(columns)});
  T* out = array.mutable_data();
  for (const ControlPose& pose : trajectory.poses()) {
    get(pose, out);
    out += std::max(columns, 1);
  }
  return array;
}

py::array_t<double> Quaternions(const FlaggedTrajectory& trajectory) {
  return Collect<double>(trajectory, 4, [](const ControlPose& pose, double* out) {
    std::copy_n(pose.T_world_body.q.coeffs().data(), 4, out);
  });
}

py::array_t<double> Positions(const FlaggedTrajectory& trajectory) {
  return Collect<double>(trajectory, 3, [](const ControlPose& pose, double* out) {
    std::copy_n(pose.T_world_body.t.data(), 3, out);
  });
}

py::object Flags(const FlaggedTrajectory& trajectory) {
  if (!trajectory.has_flags()) return py::none();
  return Collect<std::uint32_t>(trajectory, 0,
                                [](const ControlPose& pose, auto* out) { *out = pose.flags; });
}

py::array_t<std::int64_t> TimesNs(const FlaggedTrajectory& trajectory) {
  return Collect<std::int64_t>(trajectory, 0,
                               [](const ControlPose& pose, auto* out) { *out = pose.t_ns; });
}

/// What a pickle holds; matrices would not give the same bits again.
py::tuple State(const FlaggedTrajectory& trajectory) {
  return py::make_tuple(TimesNs(trajectory), Quaternions(trajectory), Positions(trajectory),
                        Flags(trajectory));
}

FlaggedTrajectory FromState(const py::tuple& state) {
  const auto fail = [] { throw DataError("this is no pickle of a trajectory of this version"); };
  if (state.size() != 4) fail();
  const std::vector<std::int64_t> times_ns = ReadIntegers(state[0], "times_ns");
  const auto q = py::cast<py::array_t<double, py::array::c_style>>(state[1]);
  const auto t = py::cast<py::array_t<double, py::array::c_style>>(state[2]);
  const bool has_flags = !state[3].is_none();
  const std::vector<std::int64_t> flags =
      has_flags ? ReadIntegers(state[3], "flags") : std::vector<std::int64_t>(times_ns.size());
  const auto count = static_cast<py::ssize_t>(times_ns.size());
  if (q.size() != 4 * count || t.size() != 3 * count || flags.size() != times_ns.size()) fail();
  Trajectory trajectory;
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    const SE3 pose{Eigen::Quaterniond(q.data() + 4 * i), Eigen::Vector3d(t.data() + 3 * i)};
    trajectory.Append({times_ns[i], pose, static_cast<unsigned>(flags[i])});
  }
  if (!has_flags) return FlaggedTrajectory(trajectory);
  return {trajectory, PoseFlags(trajectory.poses(), std::nullopt)};
}

void SaveTum(const Trajectory& trajectory, const std::string& path, bool overwrite) {
  const py::gil_scoped_release release;
  TumWriter writer(path, overwrite ? IfExists::kReplace : IfExists::kFail);
  for (const ControlPose& pose : trajectory.poses()) writer.Append(pose.t_ns, pose.T_world_body);
  writer.Close();
}

std::string Text(const FlaggedTrajectory& trajectory) {
  const std::vector<ControlPose>& poses = trajectory.poses();
  if (poses.empty()) return "<trajlo.Trajectory without poses>";
  return "<trajlo.Trajectory of " + std::to_string(poses.size()) + " poses from " +
         FormatSeconds(poses.front().t_ns) + " s to " + FormatSeconds(poses.back().t_ns) + " s>";
}

}  // namespace

void BindTrajectory(py::module_* module) {
  py::class_<FlaggedTrajectory>(*module, "Trajectory", kDoc)
      .def(py::init([](const py::object& times_ns, const py::object& poses) {
             return FlaggedTrajectory(
                 Make(ReadIntegers(times_ns, "times_ns"), ReadPoses(poses, "poses")));
           }),
           py::arg("times_ns"), py::arg("poses"))
      .def("at", &At, py::arg("times_s") = py::none(), py::kw_only(),
           py::arg("times_ns") = py::none(), py::arg("outside") = "raise", kAtDoc)
      .def("sample", &Sample, py::arg("times_s") = py::none(), py::kw_only(),
           py::arg("times_ns") = py::none(), kSampleDoc)
      .def(
          "save_tum",
          [](const FlaggedTrajectory& trajectory, const py::object& path, bool overwrite) {
            SaveTum(trajectory, PathText(path), overwrite);
          },
          py::arg("path"), py::arg("overwrite") = false,
          "Writes \"t x y z qx qy qz qw\" lines, s and m, as trajlo_run does. Raises OutputError.")
      .def_property_readonly("times_ns", &TimesNs, "(N,) int64, nanoseconds.")
      .def_property_readonly(
          "times",
          [](const FlaggedTrajectory& trajectory) {
            return Collect<double>(trajectory, 0,
                                   [](const auto& pose, auto* out) { *out = Seconds(pose.t_ns); });
          },
          "(N,) float64, seconds; since 1970 they are rounded to 0.2 us, and times_ns is exact.")
      .def_property_readonly(
          "poses",
          [](const FlaggedTrajectory& trajectory) { return PoseArray(PosesOf(trajectory)); },
          "(N, 4, 4) float64: T_world_body, metres.")
      .def_property_readonly("positions", &Positions, "(N, 3) float64, metres, world frame.")
      .def_property_readonly("quaternions", &Quaternions,
                             "(N, 4) float64: qx qy qz qw of T_world_body, of unit norm.")
      .def_property_readonly("flags", &Flags, kFlagsDoc)
      .def(py::pickle(&State, &FromState))
      .def("__len__", [](const FlaggedTrajectory& trajectory) { return trajectory.poses().size(); })
      .def("__repr__", &Text);
}

}  // namespace trajlo::python
